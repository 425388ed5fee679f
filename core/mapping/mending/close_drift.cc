// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/close_drift.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/mapping/adjustment/adjust_global.h"
#include "core/mapping/checks/compare_models.h"
#include "core/mapping/checks/torn_pairs.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/model/merge_points.h"
#include "core/mapping/model/reconstructed_share.h"
#include "core/mapping/model/retriangulate_pairs.h"

namespace orbweave {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
/// As COLMAP allows points that are made anew.
constexpr double kDrift_rad = 5.0 * kDegree_rad;
/// What a step that is 4 m wrong makes of a wall 8 m away.
constexpr double kTorn_rad = 30.0 * kDegree_rad;
constexpr double kMostReconstructed = 0.2;
constexpr int kMinInliersFactor = 2;

/// A pair whose matches are off by more than points may be, and by less than it may have drifted.
struct DriftedPair {
  uint32_t pair = 0;  ///< of the graph
  double tolerance_px = 0;
};

/// By what tolerance its matches are to become points; nullopt where the pair has not drifted
/// apart, or by more than `drift_rad`.
std::optional<double> DriftOf(const MappingState& state,
                              const LinkedPair& pair,
                              double drift_rad,
                              const MappingOptions& options) {
  const auto fewest = static_cast<size_t>(kMinInliersFactor * options.min_inliers);
  if (!state.IsRegistered(pair.a) || !state.IsRegistered(pair.b) ||
      ReconstructedShare(state, pair) >= kMostReconstructed)
    return std::nullopt;
  const double planes_px = kMatchTolerance * options.max_error_px;
  const std::vector<PosedMatch> own = OwnMatches(state, pair, planes_px);
  if (own.size() < fewest) return std::nullopt;
  const double tolerance_px = drift_rad / own.front().pixel_rad;
  size_t in_planes = 0;
  size_t about_there = 0;
  for (const PosedMatch& match : own) {
    in_planes += match.IsInPlanes(planes_px) ? 1 : 0;
    about_there += match.Agrees(tolerance_px) ? 1 : 0;
  }
  const double usual = kShareInPlanes * static_cast<double>(own.size());
  const bool has_drifted =
      static_cast<double>(in_planes) < usual && static_cast<double>(about_there) >= usual;
  return has_drifted ? std::optional(tolerance_px) : std::nullopt;
}

std::vector<DriftedPair> FindDrifted(const MappingState& state, const MappingOptions& options) {
  const std::vector<ImagePair> found = FindTornPairs(state, options);
  const std::set<ImagePair> torn(found.begin(), found.end());
  std::vector<DriftedPair> drifted;
  const std::vector<LinkedPair>& pairs = state.Graph().pairs;
  for (uint32_t p = 0; p < pairs.size(); ++p) {
    const bool is_torn = torn.contains(state.Problem().pairs[pairs[p].index].pair);
    const double drift_rad = is_torn ? kTorn_rad : kDrift_rad;
    if (const auto tolerance_px = DriftOf(state, pairs[p], drift_rad, options))
      drifted.push_back({p, *tolerance_px});
  }
  return drifted;
}

/// Common points of what the pair matches, where one explains both features to the tolerance.
void MakeCommonPoints(MappingState& state, const DriftedPair& drifted, double min_angle_deg) {
  const LinkedPair& pair = state.Graph().pairs[drifted.pair];
  RetriangulatePair(
      state, pair, {.max_error_px = drifted.tolerance_px, .min_angle_deg = min_angle_deg});
  for (const FeatureMatch& match : state.Problem().pairs[pair.index].inliers) {
    const PointIndex a = state.PointOf(state.Graph().node_of_feature[pair.a][match.a]);
    const PointIndex b = state.PointOf(state.Graph().node_of_feature[pair.b][match.b]);
    if (a != kNoPoint && b != kNoPoint && a != b) MergePair(state, a, b, drifted.tolerance_px);
  }
}

}  // namespace

absl::StatusOr<bool> CloseDrift(MappingState& state,
                                const MappingOptions& options,
                                const StageContext& context) {
  const std::vector<DriftedPair> drifted = FindDrifted(state, options);
  if (drifted.empty()) return false;
  MappingState closed = state;
  double widest_px = 0.0;
  for (const DriftedPair& each : drifted) {
    MakeCommonPoints(closed, each, options.min_angle_deg);
    widest_px = std::max(widest_px, each.tolerance_px);
  }
  ORBWEAVE_RETURN_IF_ERROR(AdjustWidely(closed, options, widest_px, context));
  ORBWEAVE_RETURN_IF_ERROR(AdjustGrowingModel(closed, options, context));
  const double tolerance_px = kMatchTolerance * options.max_error_px;
  if (CountMatchesInPlanes(closed, tolerance_px) <= CountMatchesInPlanes(state, tolerance_px) ||
      IsLikedByGnss(state, closed, options))
    return false;
  state = std::move(closed);
  return true;
}

}  // namespace orbweave
