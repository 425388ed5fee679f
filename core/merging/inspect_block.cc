// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/merging/inspect_block.h"

#include <algorithm>
#include <cstdint>

#include "core/bundle/bundle_eliminator.h"
#include "core/merging/terms_of_block.h"

namespace orbweave {
namespace {

/// A block's bearings alone: priors are weighted anew when the whole world is known.
AdjustmentBlock BearingsOf(const WorldBlock& block) {
  AdjustmentBlock terms = TermsOf(block);
  terms.problem.position_priors.clear();
  terms.problem.direction_priors.clear();
  terms.problem.bias_sigma_m.clear();
  terms.gauge.anchor.reset();
  terms.gauge.farthest.reset();
  std::vector<uint8_t> observes(terms.pose_ids.size(), 0);
  for (const BundleObservation& seen : terms.problem.observations) observes[seen.pose] = 1;
  for (size_t pose = 0; pose < observes.size(); ++pose) {
    if (observes[pose] == 0) terms.gauge.pose_is_held[pose] = 1;  // no variable
  }
  return terms;
}

/// Variables that stay: poses that see something, and split points.
struct Kept {
  KeptVariables local{};
  std::vector<SeparatorId> ids{};
};

Kept KeptOf(const WorldBlock& block, const AdjustmentBlock& terms) {
  Kept kept;
  for (uint32_t pose = 0; pose < terms.pose_ids.size(); ++pose) {
    if (terms.gauge.pose_is_held[pose] != 0) continue;
    kept.local.poses.push_back(pose);
    kept.ids.push_back({SeparatorId::Kind::kPose, terms.pose_ids[pose]});
  }
  for (uint32_t i = 0; i < block.split.size(); ++i) {
    kept.local.points.push_back(i);
    kept.ids.push_back({SeparatorId::Kind::kPoint, block.split[i].id});
  }
  return kept;
}

/// Two equations per observation, less the unknowns of points that are eliminated.
double RedundancyOf(const WorldBlock& block) {
  double redundancy = 0.0;
  for (const Track& track : block.scene.tracks)
    redundancy += 2.0 * static_cast<double>(track.observations.size()) - 3.0;
  for (const SplitTrack& track : block.split)
    redundancy += 2.0 * static_cast<double>(track.part.observations.size());
  return redundancy;
}

void AddBearings(const WorldBlock& block, int num_threads, BlockInspection& inspection) {
  const AdjustmentBlock terms = BearingsOf(block);
  const Kept kept = KeptOf(block, terms);
  BundleEliminator eliminator(
      terms.problem, terms.gauge, kept.local, {.loss = BundleLoss::kLeastSquares}, num_threads);
  const EvaluatedState state = eliminator.Start();
  inspection.sum_of_squares = 2.0 * eliminator.Cost(state);
  inspection.redundancy = RedundancyOf(block);
  SeparatorSystem& system = inspection.bearings;
  system.is_definite = eliminator.Linearize(state, {.lambda = kUnheldPointDamping});
  if (!system.is_definite) return;
  system.variables = kept.ids;
  system.normal = eliminator.Remaining();
}

}  // namespace

BlockInspection InspectBlock(const WorldBlock& block, int num_threads) {
  BlockInspection inspection{.farthest = block.farthest, .placements = PlaceBySides(block)};
  AddBearings(block, num_threads, inspection);
  const auto held = std::ranges::find_if(block.images, &BlockImage::is_held);
  if (held != block.images.end()) inspection.held = held->id;
  return inspection;
}

}  // namespace orbweave
