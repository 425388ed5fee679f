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

/// A pair of one drive whose camera has not turned.
class UnturnedPair {
 public:
  UnturnedPair(const ClusterProblem& problem, const TwoViewGeometry& pair, double max_error_px)
      : pair_(pair),
        a_(problem.images[*SlotOf(problem, pair.pair.a)]),
        b_(problem.images[*SlotOf(problem, pair.pair.b)]),
        max_error_rad_(std::max(a_.camera.AngleFromPixels(max_error_px),
                                b_.camera.AngleFromPixels(max_error_px))) {}

  [[nodiscard]] bool IsOne() const {
    return a_.drive == b_.drive && RotationAngle(pair_.b_from_a.rotation) <= max_error_rad_;
  }
  [[nodiscard]] uint32_t Drive() const { return a_.drive; }

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
  [[nodiscard]] uint32_t Cell(const FeatureMatch& match) const {
    return SphereCell(a_.bearings[match.a], kCells);
  }
  /// The pair without fixed matches in these cells, otherwise as it was found.
  [[nodiscard]] TwoViewGeometry Without(const std::set<uint32_t>& cells) const {
    TwoViewGeometry scene = pair_;
    std::erase_if(scene.inliers, [&](const FeatureMatch& match) {
      return IsFixed(match) && cells.contains(Cell(match));
    });
    return scene;
  }

 private:
  const TwoViewGeometry& pair_;
  const ClusterImage& a_;
  const ClusterImage& b_;
  double max_error_rad_;
};

using CellsOfDrives = std::map<uint32_t, std::set<uint32_t>>;

CellsOfDrives FindCarriers(const ClusterProblem& problem, double max_error_px) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> pairs_in_cell;  // by drive and cell
  for (const TwoViewGeometry& pair : problem.pairs) {
    const UnturnedPair unturned(problem, pair, max_error_px);
    if (!unturned.IsOne() || !unturned.HasMovedFar()) continue;
    std::set<uint32_t> cells;
    for (const FeatureMatch& match : pair.inliers) {
      if (unturned.IsFixed(match)) cells.insert(unturned.Cell(match));
    }
    for (const uint32_t cell : cells) ++pairs_in_cell[{unturned.Drive(), cell}];
  }
  CellsOfDrives carriers;
  for (const auto& [drive_and_cell, count] : pairs_in_cell) {
    if (count >= kFewestPairs) carriers[drive_and_cell.first].insert(drive_and_cell.second);
  }
  return carriers;
}

}  // namespace

std::optional<SceneAlone> LeaveOutCarrier(const ClusterProblem& problem, double max_error_px) {
  const CellsOfDrives carriers = FindCarriers(problem, max_error_px);
  if (carriers.empty()) return std::nullopt;
  SceneAlone scene{.problem = {.images = problem.images}};
  for (const TwoViewGeometry& pair : problem.pairs) {
    const UnturnedPair unturned(problem, pair, max_error_px);
    const auto carrier = carriers.find(unturned.Drive());
    const bool has_carrier = unturned.IsOne() && carrier != carriers.end();
    TwoViewGeometry left = has_carrier ? unturned.Without(carrier->second) : pair;
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
