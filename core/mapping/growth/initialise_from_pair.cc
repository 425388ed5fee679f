// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/growth/initialise_from_pair.h"

#include <array>
#include <utility>

#include "core/base/quantile.h"
#include "core/mapping/adjustment/adjust_part.h"
#include "core/mapping/model/filter_points.h"
#include "core/mapping/model/mapping_schedule.h"

namespace orbweave {
namespace {

constexpr double kMinKeptShare = 0.1;
constexpr double kMaxMedianShare = 0.5;

void TriangulateMatches(MappingState& state, const LinkedPair& pair, const TrackLimits& limits) {
  for (const FeatureMatch& match : state.Problem().pairs[pair.index].inliers) {
    const Node a = state.Graph().node_of_feature[pair.a][match.a];
    const Node b = state.Graph().node_of_feature[pair.b][match.b];
    if (state.PointOf(a) == kNoPoint && state.PointOf(b) == kNoPoint) {
      CreatePoint(state, a, {&b, 1}, limits);
    }
  }
}

/// Median over all observations of the error as a share of the error allowed.
double MedianErrorShare(const MappingState& state, const TrackLimits& limits) {
  std::vector<double> shares;
  for (const PointIndex point : AllPoints(state)) {
    for (const Node node : state.Point(point).nodes) {
      shares.push_back(NodeError(state, state.Point(point).position, node) /
                       AngleFromPixels(state, node, limits.max_error_px));
    }
  }
  if (shares.empty()) return 1.0;
  return UpperMedian(std::move(shares));
}

}  // namespace

absl::StatusOr<bool> InitialiseFromPair(MappingState& state,
                                        const LinkedPair& pair,
                                        const MappingOptions& options,
                                        const StageContext& context) {
  const TrackLimits limits = LimitsOf(options);
  const TwoViewGeometry& geometry = state.Problem().pairs[pair.index];
  const std::array<ImageSlot, 2> images = {pair.a, pair.b};
  state.Register(pair.a, Rigid3{});
  state.Register(pair.b, geometry.b_from_a);
  TriangulateMatches(state, pair, limits);

  const auto min_points = static_cast<uint32_t>(options.min_inliers);
  if (state.NumPoints() < min_points) return false;
  const BundleOptions how = AsPresetAdjusts(options, {.max_iterations = 30});
  ORBWEAVE_RETURN_IF_ERROR(AdjustPart(state, images, AllPoints(state), how, context).status());
  TriangulateMatches(state, pair, limits);
  FilterPoints(state, AllPoints(state), limits);
  return state.NumPoints() >= min_points &&
         state.NumPoints() >= kMinKeptShare * static_cast<double>(geometry.inliers.size()) &&
         MedianErrorShare(state, limits) <= kMaxMedianShare;
}

}  // namespace orbweave
