// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/dense/plane_field.h"
#include "core/dense/reference_raster.h"

namespace orbweave {

/// Planes of the surroundings, and which of them a pixel without texture may lie on.
struct PlanarPrior {
  static constexpr uint8_t kNone = 255;

  int face_px = 0;
  std::vector<Eigen::Vector3f> planes{};  ///< q.x = 1 in the camera frame
  std::vector<float> scatter_m{};         ///< rms distance of their pixels from them
  std::vector<uint8_t> labels{};          ///< of the raster's pixels: index of a plane, or kNone
};

/// Sequential RANSAC (Fischler, Bolles 1981) over the pixels that match well, each of which
/// proposes its own plane; then each pixel looks along its row and column, to both sides, for the
/// nearest that lie on a plane. It may lie on the plane that it meets most often, of several on the
/// nearest: on one that stands upright only if it meets it twice, once above (so that the sky
/// between two houses stays sky), on a level one if it meets two (streets have some a kerb apart).
[[nodiscard]] PlanarPrior FitPlanarPrior(const ReferenceRaster& raster,
                                         const PlaneField& field,
                                         uint64_t seed);

}  // namespace orbweave
