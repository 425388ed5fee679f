// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/map_view.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

namespace orbweave {
namespace {

constexpr double kMinHeight = 220.0;
constexpr double kMaxHeight = 680.0;
constexpr double kMargin = 46.0;

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
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  axes.row(0) = solver.eigenvectors().col(2).transpose();
  axes.row(1) = solver.eigenvectors().col(1).transpose();
  for (int row = 0; row < 2; ++row) {  // a sign that does not depend on the solver
    int largest = 0;
    axes.row(row).cwiseAbs().maxCoeff(&largest);
    if (axes(row, largest) < 0.0) axes.row(row) *= -1.0;
  }
  return axes;
}

}  // namespace

MapView FitMapView(const MapImages& images, bool georeferenced) {
  MapView view;
  view.axes = MapAxes(images, georeferenced);
  view.low.setConstant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -view.low;
  for (const ReportImage* image : images) {
    const Eigen::Vector2d p = view.axes * image->centre_in_world;
    view.low = view.low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector2d extent = (high - view.low).cwiseMax(1e-9);
  view.units_per_pixel =
      std::max(extent.x() / (kMapWidth - 2 * kMargin), extent.y() / (kMaxHeight - 2 * kMargin));
  const Eigen::Vector2d drawn = extent / view.units_per_pixel;
  view.height = std::max(kMinHeight, drawn.y() + 2 * kMargin);
  view.offset = 0.5 * (Eigen::Vector2d(kMapWidth, view.height) - drawn);
  return view;
}

}  // namespace orbweave
