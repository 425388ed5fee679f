// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/corridor_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/quantile.h"
#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr double kCornerRadiusM = 12.0;
constexpr double kLongestBlockM = 150.0;
constexpr double kLaneDistanceM = 5.0;  // of a street's two directions
constexpr double kSecondDriveM = 2.0;   // beside the first
constexpr double kTrembleM = 0.002;     // of a carrier that stands
constexpr double kMouthM = 8.0;         // from here the street before a tunnel is seen

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
    case CorridorShape::kUturn: {
      const double turn_m = 0.5 * std::numbers::pi * kLaneDistanceM;
      const double out_m = 0.5 * std::max(length_m - turn_m, 0.0) + 0.5 * kLaneDistanceM;
      return {{{0.0, 0.0}, {out_m, 0.0}, {out_m, kLaneDistanceM}, {0.0, kLaneDistanceM}},
              0.5 * kLaneDistanceM,
              false};
    }
    case CorridorShape::kBends:
      break;
  }
  return {BendCorners(length_m, static_cast<uint64_t>(options.seed)), kCornerRadiusM, false};
}

/// Subtracts the median of the stations, axis by axis.
void Centre(CorridorPath& path) {
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> values;
    for (const CorridorStation& station : path.stations)
      values.push_back(station.place.position[axis]);
    const double median = UpperMedian(std::move(values));
    for (CorridorCell& cell : path.cells) cell.place.position[axis] -= median;
    for (CorridorStation& station : path.stations) station.place.position[axis] -= median;
  }
}

std::vector<CorridorCell> MakeCells(const CorridorOptions& options, int count) {
  const StreetPath path = MakePath(options, count * options.spacing_m);
  const double step_m = path.closed() ? path.length_m() / count : options.spacing_m;
  std::vector<CorridorCell> cells;
  cells.reserve(static_cast<size_t>(count));
  const int tunnel_begin = (count - options.tunnel_panoramas) / 2;
  const int tunnel_end = tunnel_begin + options.tunnel_panoramas;
  for (int i = 0; i < count; ++i) {
    const int from_mouth = std::min(i - tunnel_begin, tunnel_end - 1 - i);
    cells.push_back({.place = path.At(i * step_m),
                     .in_tunnel = from_mouth >= 0,
                     .sees_street = from_mouth * step_m < kMouthM});
  }
  return cells;
}

/// Further panoramas at the last station.
void Stand(int count, Random& random, std::vector<CorridorStation>& stations) {
  CorridorStation here = stations.back();
  const Eigen::Vector2d place = here.place.position;
  here.standing = true;
  for (int i = 0; i < count; ++i) {
    here.place.position = place + kTrembleM * Eigen::Vector2d(random.Normal(), random.Normal());
    stations.push_back(here);
  }
}

}  // namespace

CorridorPath MakeCorridorPath(const CorridorOptions& options) {
  const int second_drive = options.drives == 2 ? options.panoramas / 2 : 0;
  const int first_drive = options.panoramas - second_drive;
  const int standing = std::clamp(options.stop_panoramas - 1, 0, first_drive - 1);
  const int count = first_drive - standing;
  CorridorPath path{.cells = MakeCells(options, count)};
  path.stations.reserve(static_cast<size_t>(options.panoramas));
  Random random(static_cast<uint64_t>(options.seed) * 3 + 0x57a4d);
  for (int i = 0; i < count; ++i) {
    const auto cell = static_cast<uint32_t>(i);
    path.stations.push_back({.place = path.cells[cell].place, .cell = cell});
    if (i == count / 2) Stand(standing, random, path.stations);
  }
  for (int i = 0; i < second_drive; ++i) {
    const auto cell = static_cast<uint32_t>(i % count);
    CorridorStation station{.place = path.cells[cell].place, .cell = cell, .drive = 1};
    station.place.position += kSecondDriveM * station.place.Left();
    path.stations.push_back(station);
  }
  Centre(path);
  return path;
}

}  // namespace orbweave
