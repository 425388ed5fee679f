// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/dense/plane_errors.h"
#include "core/dense/plane_field.h"
#include "core/dense/reference_raster.h"

namespace orbweave {

/// A pixel that matches well, in the camera frame.
struct ReliablePoint {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;
  uint32_t pixel;        ///< of EquiangularRaster
  float sigma_m = 0.0F;  ///< across its own plane
};

/// n.x = d with unit n.
struct FittedPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float distance_m = 0.0F;
  PlaneErrors errors{};

  /// q.x = 1.
  [[nodiscard]] Eigen::Vector3f InverseForm() const { return normal / distance_m; }
};

/// The pixels of a raster whose planes match well and are well determined.
[[nodiscard]] std::vector<ReliablePoint> ReliablePoints(const ReferenceRaster& raster,
                                                        const PlaneField& field);

/// Within 12 mm and 0.6 % of the range, with a normal within 26 degrees.
[[nodiscard]] bool LiesOn(const ReliablePoint& point, const FittedPlane& plane);

/// Distance of a point from a plane in tolerances of LiesOn.
[[nodiscard]] float TolerancesOff(const ReliablePoint& point, const FittedPlane& plane);

/// The plane that a point lies on, of several the nearest; else planes.size().
[[nodiscard]] size_t NearestPlane(const ReliablePoint& point,
                                  const std::vector<FittedPlane>& planes);

/// Sequential RANSAC (Fischler, Bolles 1981) over the points, each of which proposes its own plane.
/// Fitted with the weights 1 / sigma^2 of the points, 121 of which (a patch) share errors; its
/// relief is what ReliefOf tells of them, and of a plane that tells nothing what LiesOn allows,
/// alike everywhere (its square over 3). What errors of points far away cut into layers is one
/// plane again. Only planes as roads and walls have them, within 12 degrees: level and below the
/// camera, or upright. `y` of the camera frame points down. `face_px` is that of the points'
/// pixels.
[[nodiscard]] std::vector<FittedPlane> FindPlanes(int face_px,
                                                  const std::vector<ReliablePoint>& points,
                                                  uint64_t seed);

}  // namespace orbweave
