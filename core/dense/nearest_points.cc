// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/nearest_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/status.h"

namespace orbweave {
namespace {

constexpr int64_t kParts = 8;  // along an axis of a cube
constexpr double kFarthestCube = 1e15;

double SquaredDistanceToBox(const Eigen::Vector3d& point, const Eigen::Vector3d& low, double size) {
  const Eigen::Vector3d beyond =
      (low - point).cwiseMax(point - low - Eigen::Vector3d::Constant(size)).cwiseMax(0.0);
  return beyond.squaredNorm();
}

}  // namespace

size_t NearestPoints::CubeHash::operator()(const Cube& cube) const {
  uint64_t hash = 0;
  for (const int64_t axis : cube) {
    hash = (hash ^ static_cast<uint64_t>(axis)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return static_cast<size_t>(hash);
}

NearestPoints::Cube NearestPoints::CubeOf(const Eigen::Vector3d& point) const {
  Cube cube;
  for (int axis = 0; axis < 3; ++axis) {
    const double place = std::floor(point[axis] / limit_);
    cube[static_cast<size_t>(axis)] =
        static_cast<int64_t>(std::clamp(place, -kFarthestCube, kFarthestCube));
  }
  return cube;
}

uint16_t NearestPoints::PlaceOf(const Eigen::Vector3d& point, const Cube& cube) const {
  int64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double share =
        point[axis] / limit_ - static_cast<double>(cube[static_cast<size_t>(axis)]);
    const auto part = static_cast<int64_t>(std::clamp(share, 0.0, 1.0) * kParts);
    place = place * kParts + std::min(part, kParts - 1);
  }
  return static_cast<uint16_t>(place);
}

NearestPoints::NearestPoints(std::span<const Eigen::Vector3d> points, double limit)
    : limit_(limit) {
  ORBWEAVE_CHECK(limit > 0.0 && std::isfinite(limit));
  std::unordered_map<Cube, std::vector<Eigen::Vector3d>, CubeHash> by_cube;
  for (const Eigen::Vector3d& point : points) {
    if (point.allFinite()) by_cube[CubeOf(point)].push_back(point);
  }
  points_.reserve(points.size());
  cubes_.reserve(by_cube.size());
  for (auto& [cube, cube_points] : by_cube) {
    Divide(cube_points, cube);
    cube_points = {};
  }
  parts_.push_back({0, points_.size()});
}

void NearestPoints::Divide(std::vector<Eigen::Vector3d>& cube_points, const Cube& cube) {
  std::ranges::sort(cube_points, {}, [&](const auto& point) { return PlaceOf(point, cube); });
  Parts parts = {parts_.size(), 0};
  for (const Eigen::Vector3d& point : cube_points) {
    const uint16_t place = PlaceOf(point, cube);
    if (parts_.size() == parts.begin || parts_.back().place != place) {
      parts_.push_back({place, points_.size()});
    }
    points_.push_back(point);
  }
  parts.end = parts_.size();
  cubes_.emplace(cube, parts);
}

double NearestPoints::Search(const Eigen::Vector3d& point, const Cube& cube, double best) const {
  const Eigen::Vector3d low(limit_ * static_cast<double>(cube[0]),
                            limit_ * static_cast<double>(cube[1]),
                            limit_ * static_cast<double>(cube[2]));
  if (SquaredDistanceToBox(point, low, limit_) > best) return best;
  const auto found = cubes_.find(cube);
  if (found == cubes_.end()) return best;
  const double size = limit_ / kParts;
  for (size_t i = found->second.begin; i < found->second.end; ++i) {
    const int place = parts_[i].place;
    const Eigen::Vector3d corner(
        place / (kParts * kParts), place / kParts % kParts, place % kParts);
    if (SquaredDistanceToBox(point, low + size * corner, size) > best) continue;
    for (size_t k = parts_[i].begin; k < parts_[i + 1].begin; ++k) {
      best = std::min(best, (points_[k] - point).squaredNorm());
    }
  }
  return best;
}

double NearestPoints::DistanceTo(const Eigen::Vector3d& point) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (!point.allFinite()) return kNone;
  const Cube middle = CubeOf(point);
  const double farthest = limit_ * limit_;
  double best = Search(point, middle, farthest);
  for (int64_t i = 0; i < 27; ++i) {
    if (i == 13) continue;  // the middle
    best = Search(
        point, {middle[0] + i / 9 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i % 3 - 1}, best);
  }
  return best < farthest ? std::sqrt(best) : kNone;
}

}  // namespace orbweave
