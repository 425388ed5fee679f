// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/gnss_smoothness.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

constexpr size_t kMinTriples = 8;
constexpr double kMedianOfNormal = 0.6745;  // of its absolute value

}  // namespace

GnssSmoothness MeasureGnssSmoothness(std::span<const GnssDrive> drives) {
  std::vector<double> offs;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double squares = 0.0;
  double count = 0.0;
  for (const GnssDrive& drive : drives) {
    for (size_t i = 0; i < drive.fixes.size(); ++i) {
      const Eigen::Vector2d here = drive.fixes[i].position_in_enu.head<2>();
      sum += here;
      squares += here.squaredNorm();
      count += 1.0;
      if (i == 0 || i + 1 == drive.fixes.size()) continue;
      const Eigen::Vector2d before = drive.fixes[i - 1].position_in_enu.head<2>();
      const Eigen::Vector2d along = drive.fixes[i + 1].position_in_enu.head<2>() - before;
      const Eigen::Vector2d away = here - before;
      const double length = along.norm();
      offs.push_back(length > 0.0 ? std::abs(along.x() * away.y() - along.y() * away.x()) / length
                                  : away.norm());
    }
  }
  GnssSmoothness smoothness;
  if (offs.size() < kMinTriples) return smoothness;
  smoothness.is_known = true;
  smoothness.noise_m = Quantile(std::move(offs), 0.5) / (kMedianOfNormal * std::sqrt(1.5));
  smoothness.extent_m = std::sqrt(std::max(squares / count - (sum / count).squaredNorm(), 0.0));
  return smoothness;
}

}  // namespace orbweave
