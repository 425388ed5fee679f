// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/terms_of_block.h"

#include <algorithm>
#include <utility>

namespace orbweave {
namespace {

/// Ids of points that only this block knows start here.
constexpr uint32_t kFirstInnerPoint = 0x80000000U;

uint32_t PositionOf(const std::vector<uint32_t>& ids, uint32_t id) {
  return static_cast<uint32_t>(std::ranges::lower_bound(ids, id) - ids.begin());
}

bool IsLoose(const WorldBlock& block, ImageId id) { return block.scene.images.at(id).loose; }

void AddPoses(const WorldBlock& block, AdjustmentBlock& terms) {
  for (const BlockImage& image : block.images) {
    if (IsLoose(block, image.id)) continue;
    terms.pose_ids.push_back(image.id.value);
    terms.problem.cams_from_world.push_back(block.scene.images.at(image.id).cam_from_world);
    terms.gauge.pose_is_held.push_back(image.is_held ? 1 : 0);
    if (image.is_separator) terms.separators.push_back({SeparatorId::Kind::kPose, image.id.value});
  }
}

void AddPoint(const Track& track, uint32_t id, AdjustmentBlock& terms) {
  const auto point = static_cast<uint32_t>(terms.point_ids.size());
  terms.point_ids.push_back(id);
  terms.problem.points_in_world.push_back(track.point_in_world);
  for (const Observation& seen : track.observations) {
    terms.problem.observations.push_back({.pose = PositionOf(terms.pose_ids, seen.ref.image.value),
                                          .point = point,
                                          .bearing = seen.bearing,
                                          .sigma_rad = seen.sigma_rad});
  }
}

void AddPriors(const WorldBlock& block, AdjustmentBlock& terms) {
  for (const BlockBias& bias : block.biases) {
    terms.bias_ids.push_back(bias.group);
    terms.problem.bias_sigma_m.push_back(bias.sigma_m);
    if (bias.is_separator) terms.separators.push_back({SeparatorId::Kind::kBias, bias.group});
  }
  for (const BlockPrior& prior : block.priors) {
    PositionPrior& term = terms.problem.position_priors.emplace_back();
    term.pose = PositionOf(terms.pose_ids, prior.image.value);
    term.position_in_world = prior.position_in_world;
    term.sigma_m = prior.sigma_m;
    if (prior.bias_group) term.bias_group = PositionOf(terms.bias_ids, *prior.bias_group);
  }
  for (const BlockDirection& direction : block.directions) {
    terms.problem.direction_priors.push_back(
        {.pose = PositionOf(terms.pose_ids, direction.image.value),
         .direction_in_world = direction.direction_in_world,
         .direction_in_cam = direction.direction_in_cam,
         .sigma_rad = direction.sigma_rad});
  }
}

/// The distance is a matter of the block that holds both ends of it.
void AddGauge(const WorldBlock& block, AdjustmentBlock& terms) {
  if (!block.farthest) return;
  const auto held = std::ranges::find_if(block.images, &BlockImage::is_held);
  terms.gauge.anchor = PositionOf(terms.pose_ids, held->id.value);
  terms.gauge.farthest = PositionOf(terms.pose_ids, block.farthest->value);
}

}  // namespace

AdjustmentBlock TermsOf(const WorldBlock& block) {
  AdjustmentBlock terms;
  AddPoses(block, terms);
  AddPriors(block, terms);
  for (const SplitTrack& track : block.split) {
    AddPoint(track.part, track.id, terms);
    terms.separators.push_back({SeparatorId::Kind::kPoint, track.id});
  }
  uint32_t next = kFirstInnerPoint;
  for (const Track& track : block.scene.tracks) AddPoint(track, next++, terms);
  AddGauge(block, terms);
  return terms;
}

WorldBlock WithState(WorldBlock block, const BundleState& state) {
  size_t pose = 0;
  for (const BlockImage& image : block.images) {
    RegisteredImage& registered = block.scene.images.at(image.id);
    if (registered.loose) continue;
    const PoseState& now = state.poses[pose++];
    if (!image.is_held) registered.cam_from_world = Rigid3::FromCentre(now.rotation, now.centre);
  }
  for (size_t i = 0; i < block.biases.size(); ++i) block.biases[i].value_m = state.biases[i];
  size_t point = 0;
  for (SplitTrack& track : block.split) track.part.point_in_world = state.points[point++];
  for (Track& track : block.scene.tracks) track.point_in_world = state.points[point++];
  return block;
}

}  // namespace orbweave
