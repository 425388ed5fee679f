// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/corridor_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr double kCornerRadiusM = 12.0;
constexpr double kLongestBlockM = 150.0;

std::vector<Eigen::Vector2d> BendCorners(double length_m, uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Vector2d> corners = {Eigen::Vector2d::Zero()};
  double heading = 0.3;
  for (double station = 0.0; station < length_m;) {
    const double side_m = random.Uniform(60.0, 240.0);
    corners.push_back(corners.back() +
                      side_m * Eigen::Vector2d(std::cos(heading), std::sin(heading)));
    station += side_m;
    // Turns towards the general direction more often than away: the street gets somewhere.
    heading = std::clamp(heading + random.Uniform(-1.2, 1.2), -1.2, 1.2);
  }
  return corners;
}

/// Every street of a square grid of s x s streets: all rows there and back, then all columns; 2
/// (s^2 - 1) blocks long.
std::vector<Eigen::Vector2d> GridCorners(double length_m) {
  const double block_m = std::min(kLongestBlockM, length_m / 6.0);
  const int streets = std::max(2, static_cast<int>(std::sqrt(1.0 + length_m / (2.0 * block_m))));
  const double side_m = (streets - 1) * block_m;
  std::vector<Eigen::Vector2d> corners;
  for (int row = 0; row < streets; ++row) {
    const bool back = row % 2 == 1;
    corners.emplace_back(back ? side_m : 0.0, row * block_m);
    corners.emplace_back(back ? 0.0 : side_m, row * block_m);
  }
  const bool ends_right = streets % 2 == 1;
  for (int k = 0; k < streets; ++k) {
    const double x = (ends_right ? streets - 1 - k : k) * block_m;
    const bool down = k % 2 == 0;
    if (k > 0) corners.emplace_back(x, down ? side_m : 0.0);
    corners.emplace_back(x, down ? 0.0 : side_m);
  }
  return corners;
}

StreetPath MakePath(const CorridorOptions& options, double length_m) {
  switch (options.shape) {
    case CorridorShape::kStraight:
      return {{{0.0, 0.0}, {length_m + 1.0, 0.0}}, kCornerRadiusM, false};
    case CorridorShape::kLoop: {
      // The rounded corners cut 8r - 2 pi r off the perimeter of the rectangle.
      const double perimeter_m = length_m + (8.0 - 2.0 * std::numbers::pi) * kCornerRadiusM;
      const double long_m = 0.3 * perimeter_m;
      const double short_m = 0.2 * perimeter_m;
      return {{{0.0, 0.0}, {long_m, 0.0}, {long_m, short_m}, {0.0, short_m}}, kCornerRadiusM, true};
    }
    case CorridorShape::kGrid:
      return {GridCorners(length_m), kCornerRadiusM, false};
    case CorridorShape::kBends:
      break;
  }
  return {BendCorners(length_m, static_cast<uint64_t>(options.seed)), kCornerRadiusM, false};
}

/// Moves the street so that the median of its places is the origin: where a reader of its GNSS
/// positions puts the origin as well.
void Centre(std::vector<PathPlace>& places) {
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> values;
    for (const PathPlace& place : places) values.push_back(place.position[axis]);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    const double median = *middle;
    for (PathPlace& place : places) place.position[axis] -= median;
  }
}

}  // namespace

std::vector<PathPlace> CorridorPlaces(const CorridorOptions& options) {
  const double length_m = options.panoramas * options.spacing_m;
  const StreetPath path = MakePath(options, length_m);
  const double step_m = path.closed() ? path.length_m() / options.panoramas : options.spacing_m;
  std::vector<PathPlace> places;
  places.reserve(static_cast<size_t>(options.panoramas));
  for (int i = 0; i < options.panoramas; ++i) places.push_back(path.At(i * step_m));
  Centre(places);
  return places;
}

}  // namespace orbweave
