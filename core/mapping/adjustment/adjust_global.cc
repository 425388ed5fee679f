// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/adjust_global.h"

#include <algorithm>

#include "core/mapping/adjustment/adjust_part.h"
#include "core/mapping/model/complete_tracks.h"
#include "core/mapping/model/drop_ghost_points.h"
#include "core/mapping/model/drop_near_points.h"
#include "core/mapping/model/drop_two_view_points.h"
#include "core/mapping/model/filter_points.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/model/median_error.h"
#include "core/mapping/model/merge_coincident_points.h"
#include "core/mapping/model/merge_points.h"
#include "core/mapping/model/retriangulate_pairs.h"

namespace orbweave {
namespace {

/// Right points of two observations are fitted closer than others: 99 % within this many medians.
constexpr double kTwoViewMedians = 1.5;

/// How long rounds go on.
struct Rounds {
  int max_rounds = 1;
  double max_changed_share = 0.0;  ///< of the observations, below which the model is at rest
  bool tightens = false;           ///< judges errors by the model's own exactness
  bool drops_ghosts = false;       ///< DropGhostPoints
};

/// Returns the number of observations added and points merged.
uint32_t DensifyTracks(MappingState& state, const MappingOptions& options) {
  uint32_t changed = RetriangulatePairs(state, LimitsOf(options));
  const std::vector<PointIndex> points = AllPoints(state);
  changed += CompleteTracks(state, points, options.max_error_px);
  return changed + MergePoints(state, points, options.max_error_px);
}

absl::Status AdjustAll(MappingState& state, const BundleOptions& how, const StageContext& context) {
  return AdjustPart(state, state.Registered(), AllPoints(state), how, context).status();
}

/// options.max_error_px is what is allowed at most; where observations are more exact, those that
/// stand out from them are wrong too. Of errors with two normal components one in 1500 exceeds
/// 3.25 medians.
MappingOptions Tightened(const MappingState& state, MappingOptions options) {
  constexpr double kMedians = 3.25;
  constexpr double kFloorPx = 0.5;
  options.max_error_px =
      std::min(options.max_error_px, std::max(kFloorPx, kMedians * MedianErrorPx(state)));
  return options;
}

absl::Status AdjustInRounds(MappingState& state,
                            const MappingOptions& options,
                            const BundleOptions& how,
                            const Rounds& rounds,
                            const StageContext& context) {
  for (int round = 0; round < rounds.max_rounds; ++round) {
    const MappingOptions limits = rounds.tightens ? Tightened(state, options) : options;
    uint32_t changed = DensifyTracks(state, limits);
    if (rounds.tightens) changed += MergeCoincidentPoints(state, limits.max_error_px);
    changed += DropNearPoints(state, state.Registered());
    if (rounds.drops_ghosts) DropGhostPoints(state);
    ORBWEAVE_RETURN_IF_ERROR(AdjustAll(state, how, context));
    changed += FilterPoints(state, AllPoints(state), LimitsOf(limits));
    if (changed <= rounds.max_changed_share * state.NumObservations()) break;
  }
  return absl::OkStatus();
}

absl::Status AdjustUntilAtRest(MappingState& state,
                               const MappingOptions& options,
                               bool drops_ghosts,
                               const StageContext& context) {
  const bool tightens = ScheduleOf(options).tightens;
  const BundleOptions robust = AsPresetAdjusts(
      options, {.loss = BundleLoss::kCauchy, .max_iterations = 30, .function_tolerance = 1e-5});
  ORBWEAVE_RETURN_IF_ERROR(AdjustInRounds(state,
                                          options,
                                          robust,
                                          {.max_rounds = 5,
                                           .max_changed_share = 0.001,
                                           .tightens = tightens,
                                           .drops_ghosts = drops_ghosts},
                                          context));
  if (tightens)
    DropTwoViewPoints(state, kTwoViewMedians * MedianErrorPx(state), options.two_view_below);
  const BundleOptions exact = AsPresetAdjusts(
      options,
      {.loss = BundleLoss::kLeastSquares, .max_iterations = 30, .function_tolerance = 1e-7});
  constexpr int kMaxFinishes = 3;
  for (int finish = 0; finish < kMaxFinishes; ++finish) {
    ORBWEAVE_RETURN_IF_ERROR(AdjustAll(state, exact, context));
    const TrackLimits limits = LimitsOf(tightens ? Tightened(state, options) : options);
    if (FilterPoints(state, AllPoints(state), limits) == 0) break;
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status AdjustGrowingModel(MappingState& state,
                                const MappingOptions& options,
                                const StageContext& context) {
  const BundleOptions how = AsPresetAdjusts(
      options, {.loss = BundleLoss::kCauchy, .max_iterations = 15, .function_tolerance = 1e-4});
  return AdjustInRounds(state, options, how, {.max_rounds = 2, .max_changed_share = 0.05}, context);
}

absl::Status AdjustWidely(MappingState& state,
                          const MappingOptions& options,
                          double max_error_px,
                          const StageContext& context) {
  BundleOptions how = {
      .loss = BundleLoss::kCauchy, .max_iterations = 30, .function_tolerance = 1e-5};
  how.loss_scale *= max_error_px / options.max_error_px;
  return AdjustAll(state, AsPresetAdjusts(options, how), context);
}

absl::Status AdjustFinalModel(MappingState& state,
                              const MappingOptions& options,
                              const StageContext& context) {
  return AdjustUntilAtRest(state, options, false, context);
}

absl::Status AdjustWithoutGhosts(MappingState& state,
                                 const MappingOptions& options,
                                 const StageContext& context) {
  if (DropGhostPoints(state) == 0) return absl::OkStatus();
  return AdjustUntilAtRest(state, options, true, context);
}

}  // namespace orbweave
