// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_fusions/mutual_neighbours.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace orbweave {
namespace {

constexpr double kReachInUnits = 6.0;
constexpr double kSpacingsInReach = 6.5;  // a little less than a step of a street, see above

using Eigen::Vector3d;

/// Centres of panoramas in cubes as wide as what is looked for.
class CentreGrid {
 public:
  CentreGrid(const std::vector<Vector3d>& centres, double width_m)
      : centres_(centres), width_m_(std::max(width_m, 1e-9)) {
    for (size_t i = 0; i < centres.size(); ++i) cells_[CellOf(centres[i])].push_back(i);
  }

  /// Calls visit(other, distance) for all others within the width.
  template <typename Visit>
  void ForEachNear(size_t i, const Visit& visit) const {
    const auto [x, y, z] = CellOf(centres_[i]);
    for (int64_t dx = -1; dx <= 1; ++dx) {
      for (int64_t dy = -1; dy <= 1; ++dy) {
        for (int64_t dz = -1; dz <= 1; ++dz) VisitCell({x + dx, y + dy, z + dz}, i, visit);
      }
    }
  }

 private:
  using Cell = std::tuple<int64_t, int64_t, int64_t>;

  [[nodiscard]] Cell CellOf(const Vector3d& centre) const {
    const auto index = [this](double x) { return static_cast<int64_t>(std::floor(x / width_m_)); };
    return {index(centre.x()), index(centre.y()), index(centre.z())};
  }

  template <typename Visit>
  void VisitCell(const Cell& cell, size_t i, const Visit& visit) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return;
    for (const size_t other : found->second) {
      const double distance = (centres_[other] - centres_[i]).norm();
      if (other != i && distance <= width_m_) visit(other, distance);
    }
  }

  const std::vector<Vector3d>& centres_;
  double width_m_;
  std::map<Cell, std::vector<size_t>> cells_;
};

/// Who gives points: greedily, in the order of the plan.
std::vector<bool> ChooseGivers(const CentreGrid& grid, const std::vector<double>& reaches) {
  std::vector<bool> gives(reaches.size(), false);
  for (size_t i = 0; i < reaches.size(); ++i) {
    gives[i] = true;
    grid.ForEachNear(i, [&](size_t other, double distance) {
      if (other < i && gives[other] && distance * kSpacingsInReach < reaches[i]) gives[i] = false;
    });
  }
  return gives;
}

/// Half the distance to the neighbour that would be one too many.
double ReachForSoMany(const CentreGrid& grid,
                      size_t i,
                      const std::vector<bool>& gives,
                      size_t max_neighbours) {
  std::vector<double> distances;
  grid.ForEachNear(i, [&](size_t other, double distance) {
    if (gives[other]) distances.push_back(distance);
  });
  if (distances.size() <= max_neighbours) return std::numeric_limits<double>::infinity();
  std::ranges::sort(distances);
  return 0.5 * distances[max_neighbours];
}

}  // namespace

std::vector<Neighbourhood> MutualNeighbours(const DensePlan& plan, size_t max_neighbours) {
  std::vector<Vector3d> centres;
  std::vector<double> reaches;
  for (const DensePanorama& panorama : plan.panoramas) {
    centres.push_back(panorama.cam_from_model.Centre());
    reaches.push_back(kReachInUnits * panorama.unit_m);
  }
  if (reaches.empty()) return {};
  const CentreGrid grid(centres, 2.0 * std::ranges::max(reaches));
  const std::vector<bool> gives = ChooseGivers(grid, reaches);
  for (size_t i = 0; i < centres.size(); ++i)
    reaches[i] = std::min(reaches[i], ReachForSoMany(grid, i, gives, max_neighbours));
  std::vector<Neighbourhood> neighbourhoods(centres.size());
  for (size_t i = 0; i < centres.size(); ++i) {
    Neighbourhood& of_one = neighbourhoods[i];
    of_one.gives_points = gives[i];
    of_one.reach_m = reaches[i];
    grid.ForEachNear(i, [&](size_t other, double distance) {
      if (gives[other] && distance <= reaches[i] + reaches[other])
        of_one.neighbours.push_back(plan.panoramas[other].file.image);
    });
    std::ranges::sort(of_one.neighbours);
  }
  return neighbourhoods;
}

}  // namespace orbweave
