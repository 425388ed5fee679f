// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/facade_view.h"

#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

constexpr double kHalfWidth = std::numbers::sqrt3;  // tan 60 deg
constexpr double kUp = 1.0;                         // tan 45 deg
constexpr double kDown = 0.7;                       // tan 35 deg

/// In focal lengths from the middle: right, down.
Eigen::Vector2d Normalised(const Eigen::Vector2d& pixel, double focal_px) {
  return pixel / focal_px - Eigen::Vector2d(kHalfWidth, kUp);
}

}  // namespace

int FacadeView::Width() const { return static_cast<int>(2.0 * kHalfWidth * focal_px); }

int FacadeView::Height() const { return static_cast<int>((kUp + kDown) * focal_px); }

Eigen::Vector3d FacadeView::BearingFromPixel(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d at = Normalised(pixel, focal_px);
  const double azimuth = 2.0 * std::numbers::pi * number / kNumFacadeViews;
  const double c = std::cos(azimuth);
  const double s = std::sin(azimuth);
  return Eigen::Vector3d(c * at.x() + s, at.y(), c - s * at.x()).normalized();
}

double FacadeView::ScaleAt(const Eigen::Vector2d& pixel) const {
  return std::pow(1.0 + Normalised(pixel, focal_px).squaredNorm(), -0.75);
}

}  // namespace orbweave
