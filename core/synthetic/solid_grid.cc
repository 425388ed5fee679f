// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/solid_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace orbweave {
namespace {

constexpr double kCell_m = 4.0;
constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();  // visited at the end of a cell

/// Half extents of the axis-parallel rectangle round a solid's plan.
Eigen::Vector2d PlanHalf(const Solid& solid) {
  const Eigen::Vector2d a = solid.along.cwiseAbs();
  return {a.x() * solid.half.x() + a.y() * solid.half.y(),
          a.y() * solid.half.x() + a.x() * solid.half.y()};
}

/// Range of the ray parameter inside an axis-parallel rectangle.
std::pair<double, double> ClipToRectangle(const LightRay& ray,
                                          const Eigen::Vector2d& low,
                                          const Eigen::Vector2d& high) {
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    const double o = ray.origin[axis];
    const double d = ray.direction[axis];
    if (d == 0.0) {
      if (o < low[axis] || o > high[axis]) return {1.0, 0.0};
      continue;
    }
    const double t0 = (low[axis] - o) / d;
    const double t1 = (high[axis] - o) / d;
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return {enter, leave};
}

}  // namespace

SolidGrid::SolidGrid(const std::vector<Solid>& solids) : solids_(solids) {
  if (solids.empty()) return;
  low_ = solids.front().centre.head<2>();
  Eigen::Vector2d high = low_;
  for (const Solid& solid : solids) {
    low_ = low_.cwiseMin(solid.centre.head<2>() - PlanHalf(solid));
    high = high.cwiseMax(solid.centre.head<2>() + PlanHalf(solid));
  }
  columns_ = static_cast<int>((high.x() - low_.x()) / kCell_m) + 1;
  rows_ = static_cast<int>((high.y() - low_.y()) / kCell_m) + 1;
  std::vector<std::pair<uint32_t, uint32_t>> entries;  // (cell, solid)
  for (uint32_t s = 0; s < solids.size(); ++s) {
    const Eigen::Vector2d middle = solids[s].centre.head<2>() - low_;
    const Eigen::Vector2d half = PlanHalf(solids[s]);
    const Eigen::Vector2i first = CellOf(middle - half);
    const Eigen::Vector2i last = CellOf(middle + half);
    for (int row = first.y(); row <= last.y(); ++row) {
      for (int column = first.x(); column <= last.x(); ++column) {
        entries.emplace_back(static_cast<uint32_t>(row * columns_ + column), s);
      }
    }
  }
  std::sort(entries.begin(), entries.end());
  first_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + 1, 0);
  for (const auto& [cell, solid] : entries) {
    ++first_[cell + 1];
    members_.push_back(solid);
  }
  for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

Eigen::Vector2i SolidGrid::CellOf(const Eigen::Vector2d& from_low) const {
  const auto index = [](double x, int count) {
    return std::clamp(static_cast<int>(std::floor(x / kCell_m)), 0, count - 1);
  };
  return {index(from_low.x(), columns_), index(from_low.y(), rows_)};
}

template <typename Visitor>
void SolidGrid::Walk(const LightRay& ray, double max_distance_m, Visitor&& visit) const {
  if (solids_.empty()) return;
  const Eigen::Vector2d high = low_ + kCell_m * Eigen::Vector2d(columns_, rows_);
  auto [t, t_end] = ClipToRectangle(ray, low_, high);
  t_end = std::min(t_end, max_distance_m);
  if (t > t_end) return;
  const Eigen::Vector2i size(columns_, rows_);
  Eigen::Vector2i cell = CellOf((ray.origin + t * ray.direction).head<2>() - low_);
  int step[2];
  double next[2];   // ray parameter at which the next cell begins
  double delta[2];  // between cells
  for (int axis = 0; axis < 2; ++axis) {
    const double d = ray.direction[axis];
    step[axis] = d < 0.0 ? -1 : 1;
    const double border = (cell[axis] + (d < 0.0 ? 0 : 1)) * kCell_m + low_[axis];
    next[axis] =
        d == 0.0 ? std::numeric_limits<double>::infinity() : (border - ray.origin[axis]) / d;
    delta[axis] = d == 0.0 ? std::numeric_limits<double>::infinity() : kCell_m / std::abs(d);
  }
  while (t <= t_end) {
    const int axis = next[0] < next[1] ? 0 : 1;
    const auto index = static_cast<size_t>(cell[1] * columns_ + cell[0]);
    for (uint32_t m = first_[index]; m < first_[index + 1]; ++m) {
      if (visit(members_[m], next[axis])) return;
    }
    if (visit(kNone, next[axis])) return;
    t = next[axis];
    next[axis] += delta[axis];
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= size[axis]) return;
  }
}

GridHit SolidGrid::Nearest(const LightRay& ray, double max_distance_m) const {
  GridHit nearest;
  nearest.hit.distance_m = max_distance_m;
  bool found = false;
  Walk(ray, max_distance_m, [&](uint32_t index, double cell_end_m) {
    if (index == kNone) return found && nearest.hit.distance_m <= cell_end_m;
    const SolidHit hit = Intersect(ray, solids_[index]);
    const bool equal = hit.distance_m == nearest.hit.distance_m && found;
    if (hit.distance_m < nearest.hit.distance_m || (equal && index < nearest.solid)) {
      nearest = {hit, index};
      found = true;
    }
    return false;
  });
  return found ? nearest : GridHit{};
}

bool SolidGrid::IsHit(const LightRay& ray) const {
  bool found = false;
  Walk(ray, std::numeric_limits<double>::infinity(), [&](uint32_t index, double) {
    found = index != kNone && Intersect(ray, solids_[index]).face >= 0;
    return found;
  });
  return found;
}

}  // namespace orbweave
