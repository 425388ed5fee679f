// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/io/page/job_report.h"

namespace orbweave {

inline constexpr double kMapWidth = 1000.0;

using MapImages = std::vector<const ReportImage*>;

/// From the world to the page.
struct MapView {
  Eigen::Matrix<double, 2, 3> axes;
  Eigen::Vector2d low;
  double units_per_pixel = 1.0;
  double height = 0.0;
  Eigen::Vector2d offset;

  [[nodiscard]] Eigen::Vector2d Page(const Eigen::Vector3d& point_in_world) const {
    const Eigen::Vector2d on_map = (axes * point_in_world - low) / units_per_pixel;
    return {offset.x() + on_map.x(), height - offset.y() - on_map.y()};
  }
};

/// Shows all `images` from above or, in a free frame, along the direction in which the centres
/// spread least. The map grows by up to a quarter of its extent on each side for `marks`; those
/// further off are beyond its frame.
[[nodiscard]] MapView FitMapView(const MapImages& images,
                                 bool georeferenced,
                                 const std::vector<Eigen::Vector3d>& marks);

/// A place on the page, moved straight towards `from`, which is within, until it is within the
/// map's frame.
[[nodiscard]] Eigen::Vector2d WithinFrame(const MapView& view,
                                          const Eigen::Vector2d& from,
                                          const Eigen::Vector2d& place);

}  // namespace orbweave
