// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/leave_out_carrier.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/geometry/rotation.h"
#include "core/geometry/sphere_cells.h"
#include "core/mapping/model/correspondence_graph.h"

namespace orbweave {
namespace {

constexpr int kCells = 64;  // a side: three degrees
constexpr uint32_t kFewestPairs = 3;
constexpr double kFarthest_m = 2000.0;
constexpr double kSigmasApart = 4.0;
constexpr double kLeft = 0.5;

/// Drives, and cells in which their panoramas show the carrier.
using Carriers = std::set<std::pair<uint32_t, uint32_t>>;

/// A verified pair and the rays of its matches.
class PairOfRays {
 public:
  PairOfRays(const ClusterProblem& problem, const TwoViewGeometry& pair, double max_error_px)
      : pair_(pair),
        a_(problem.images[*SlotOf(problem, pair.pair.a)]),
        b_(problem.images[*SlotOf(problem, pair.pair.b)]),
        max_error_rad_(std::max(a_.camera.AngleFromPixels(max_error_px),
                                b_.camera.AngleFromPixels(max_error_px))) {}

  /// Whether the images are of one drive whose camera has not turned.
  [[nodiscard]] bool IsUnturned() const {
    return a_.drive == b_.drive && RotationAngle(pair_.b_from_a.rotation) <= max_error_rad_;
  }
  /// Whether positions have the images so far apart that nothing they see can be fixed.
  [[nodiscard]] bool HasMovedFar() const {
    if (!a_.prior.position_in_enu || !b_.prior.position_in_enu) return false;
    const double apart_m = (*b_.prior.position_in_enu - *a_.prior.position_in_enu).head<2>().norm();
    const double sigma_m = std::hypot(a_.prior.horizontal_sigma_m, b_.prior.horizontal_sigma_m);
    return apart_m >= std::max(kFarthest_m * max_error_rad_, kSigmasApart * sigma_m);
  }
  [[nodiscard]] bool IsFixed(const FeatureMatch& match) const {
    return IsWithinAngle(a_.bearings[match.a], b_.bearings[match.b], max_error_rad_);
  }
  [[nodiscard]] Carriers::value_type Cell(const FeatureMatch& match) const {
    return {a_.drive, SphereCell(a_.bearings[match.a], kCells)};
  }
  /// The pair without fixed matches in these cells, otherwise as it was found.
  [[nodiscard]] TwoViewGeometry Without(const Carriers& carriers) const {
    TwoViewGeometry scene = pair_;
    std::erase_if(scene.inliers, [&](const FeatureMatch& match) {
      return IsFixed(match) && carriers.contains(Cell(match));
    });
    return scene;
  }

 private:
  const TwoViewGeometry& pair_;
  const ClusterImage& a_;
  const ClusterImage& b_;
  double max_error_rad_;
};

Carriers FindCarriers(const ClusterProblem& problem, double max_error_px) {
  std::map<Carriers::value_type, uint32_t> pairs_in_cell;
  for (const TwoViewGeometry& pair : problem.pairs) {
    const PairOfRays rays(problem, pair, max_error_px);
    if (!rays.IsUnturned() || !rays.HasMovedFar()) continue;
    Carriers cells;
    for (const FeatureMatch& match : pair.inliers) {
      if (rays.IsFixed(match)) cells.insert(rays.Cell(match));
    }
    for (const auto& cell : cells) ++pairs_in_cell[cell];
  }
  Carriers carriers;
  for (const auto& [cell, count] : pairs_in_cell) {
    if (count >= kFewestPairs) carriers.insert(cell);
  }
  return carriers;
}

}  // namespace

std::optional<SceneAlone> LeaveOutCarrier(const ClusterProblem& problem, double max_error_px) {
  const Carriers carriers = FindCarriers(problem, max_error_px);
  if (carriers.empty()) return std::nullopt;
  SceneAlone scene{.problem = {.images = problem.images}};
  for (const TwoViewGeometry& pair : problem.pairs) {
    const PairOfRays rays(problem, pair, max_error_px);
    TwoViewGeometry left = rays.IsUnturned() ? rays.Without(carriers) : pair;
    if (static_cast<double>(left.inliers.size()) <
        kLeft * static_cast<double>(pair.inliers.size())) {
      scene.pairs_of_carrier.push_back(pair.pair);
    } else {
      scene.problem.pairs.push_back(std::move(left));
    }
  }
  return scene;
}

}  // namespace orbweave
