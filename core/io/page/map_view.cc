// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/map_view.h"

#include <algorithm>
#include <limits>

#include "core/geometry/symmetric_eigen.h"

namespace orbweave {
namespace {

constexpr double kMinHeight = 220.0;
constexpr double kMaxHeight = 680.0;
constexpr double kMargin = 46.0;
constexpr double kFoot = 30.0;          // of the map, for its scale and what ellipses are
constexpr double kFrame = 14.0;         // of the page, that symbols stay away from its edge
constexpr double kRoomForMarks = 0.25;  // share of the extent

/// Two rows that take a world point to the plane of the map, x right and y up.
Eigen::Matrix<double, 2, 3> MapAxes(const MapImages& images, bool georeferenced) {
  Eigen::Matrix<double, 2, 3> axes = Eigen::Matrix<double, 2, 3>::Identity();
  if (georeferenced || images.size() < 3) return axes;
  Eigen::Vector3d mean(0, 0, 0);
  for (const ReportImage* image : images)
    mean += image->centre_in_world / static_cast<double>(images.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const ReportImage* image : images) {
    const Eigen::Vector3d d = image->centre_in_world - mean;
    covariance += d * d.transpose();
  }
  const SymmetricEigen<3> spread = EigenOf<3>(covariance);
  axes.row(0) = spread.vectors.col(2).transpose();
  axes.row(1) = spread.vectors.col(1).transpose();
  for (int row = 0; row < 2; ++row) {  // a sign that does not depend on the solver
    int largest = 0;
    axes.row(row).cwiseAbs().maxCoeff(&largest);
    if (axes(row, largest) < 0.0) axes.row(row) *= -1.0;
  }
  return axes;
}

}  // namespace

MapView FitMapView(const MapImages& images,
                   bool georeferenced,
                   const std::vector<Eigen::Vector3d>& marks) {
  MapView view;
  view.axes = MapAxes(images, georeferenced);
  view.low.setConstant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -view.low;
  for (const ReportImage* image : images) {
    const Eigen::Vector2d p = view.axes * image->centre_in_world;
    view.low = view.low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  // A street that runs straight has no extent across: its longer side counts.
  const double room = kRoomForMarks * (high - view.low).maxCoeff();
  const Eigen::Vector2d lowest = view.low.array() - room;
  const Eigen::Vector2d highest = high.array() + room;
  for (const Eigen::Vector3d& mark : marks) {
    const Eigen::Vector2d p = view.axes * mark;
    view.low = view.low.cwiseMin(p.cwiseMax(lowest));
    high = high.cwiseMax(p.cwiseMin(highest));
  }
  const Eigen::Vector2d extent = (high - view.low).cwiseMax(1e-9);
  view.units_per_pixel =
      std::max(extent.x() / (kMapWidth - 2 * kMargin), extent.y() / (kMaxHeight - 2 * kMargin));
  const Eigen::Vector2d drawn = extent / view.units_per_pixel;
  const double height = std::max(kMinHeight, drawn.y() + 2 * kMargin);
  view.height = height + kFoot;
  view.offset = 0.5 * (Eigen::Vector2d(kMapWidth, height) - drawn) + Eigen::Vector2d(0.0, kFoot);
  return view;
}

Eigen::Vector2d WithinFrame(const MapView& view,
                            const Eigen::Vector2d& from,
                            const Eigen::Vector2d& place) {
  const Eigen::Vector2d low(kFrame, kFrame);
  const Eigen::Vector2d high(kMapWidth - kFrame, view.height - kFoot - kFrame);
  const Eigen::Vector2d way = place - from;
  double share = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    if (way[axis] > 0.0) share = std::min(share, (high[axis] - from[axis]) / way[axis]);
    if (way[axis] < 0.0) share = std::min(share, (low[axis] - from[axis]) / way[axis]);
  }
  return from + std::max(share, 0.0) * way;
}

}  // namespace orbweave
