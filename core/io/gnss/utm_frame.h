// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/scene/image_manifest.h"
#include "core/scene/surface_point.h"

namespace orbweave {

/// The UTM zone (WGS 84) of a local east-north-up frame: easting, northing, height above the
/// ellipsoid; metres. Near the poles, where UTM ends, UPS. Karney, GeographicLib::UTMUPS.
class UtmFrame {
 public:
  explicit UtmFrame(const GeodeticPosition& origin);

  /// The frame's origin, rounded to metres.
  [[nodiscard]] Eigen::Vector3d Origin() const;
  /// Well-known text (WKT 1) of zone and datum.
  [[nodiscard]] std::string Wkt() const;
  /// A position of the east-north-up frame.
  [[nodiscard]] Eigen::Vector3d FromEnu(const Eigen::Vector3d& position) const;
  /// Points of the east-north-up frame; normals are turned by the convergence of meridians.
  [[nodiscard]] std::vector<SurfacePoint> FromEnu(std::span<const SurfacePoint> points) const;

 private:
  [[nodiscard]] Eigen::Vector3d FromGeodetic(const GeodeticPosition& position) const;

  GeodeticPosition origin_;
  int zone_ = 0;
  bool is_north_ = true;
  double convergence_rad_ = 0.0;  ///< of the origin: from grid north to true north, clockwise
};

}  // namespace orbweave
