// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjust_global.h"

#include "core/mapping/adjust_part.h"
#include "core/mapping/complete_tracks.h"
#include "core/mapping/filter_points.h"
#include "core/mapping/mapping_schedule.h"
#include "core/mapping/merge_points.h"
#include "core/mapping/retriangulate_pairs.h"

namespace orbweave {
namespace {

/// How long rounds go on.
struct Rounds {
  int max_rounds = 1;
  double max_changed_share = 0.0;  ///< of the observations, below which the model is at rest
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

absl::Status AdjustInRounds(MappingState& state,
                            const MappingOptions& options,
                            const BundleOptions& how,
                            const Rounds& rounds,
                            const StageContext& context) {
  for (int round = 0; round < rounds.max_rounds; ++round) {
    uint32_t changed = DensifyTracks(state, options);
    ORBWEAVE_RETURN_IF_ERROR(AdjustAll(state, how, context));
    changed += FilterPoints(state, AllPoints(state), LimitsOf(options));
    if (changed <= rounds.max_changed_share * state.NumObservations()) break;
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status AdjustGrowingModel(MappingState& state,
                                const MappingOptions& options,
                                const StageContext& context) {
  const BundleOptions how = {
      .loss = BundleLoss::kCauchy, .max_iterations = 15, .function_tolerance = 1e-4};
  return AdjustInRounds(state, options, how, {.max_rounds = 2, .max_changed_share = 0.05}, context);
}

absl::Status AdjustFinalModel(MappingState& state,
                              const MappingOptions& options,
                              const StageContext& context) {
  const BundleOptions robust = {
      .loss = BundleLoss::kCauchy, .max_iterations = 30, .function_tolerance = 1e-5};
  ORBWEAVE_RETURN_IF_ERROR(AdjustInRounds(
      state, options, robust, {.max_rounds = 4, .max_changed_share = 0.001}, context));
  const BundleOptions exact = {
      .loss = BundleLoss::kLeastSquares, .max_iterations = 30, .function_tolerance = 1e-7};
  constexpr int kMaxFinishes = 3;
  for (int finish = 0; finish < kMaxFinishes; ++finish) {
    ORBWEAVE_RETURN_IF_ERROR(AdjustAll(state, exact, context));
    if (FilterPoints(state, AllPoints(state), LimitsOf(options)) == 0) break;
  }
  return absl::OkStatus();
}

}  // namespace orbweave
