// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/terms_of_subproblem.h"

#include <algorithm>
#include <utility>

namespace orbweave {
namespace {

/// Ids of points that only this subproblem knows start here.
constexpr uint32_t kFirstInnerPoint = 0x80000000U;

uint32_t PositionOf(const std::vector<uint32_t>& ids, uint32_t id) {
  return static_cast<uint32_t>(std::ranges::lower_bound(ids, id) - ids.begin());
}

bool IsLoose(const Subproblem& subproblem, ImageId id) {
  return subproblem.scene.images.at(id).loose;
}

void AddPoses(const Subproblem& subproblem, BundleSubproblem& terms) {
  for (const SubproblemImage& image : subproblem.images) {
    if (IsLoose(subproblem, image.id)) continue;
    terms.pose_ids.push_back(image.id.value);
    terms.problem.cams_from_world.push_back(subproblem.scene.images.at(image.id).cam_from_world);
    terms.gauge.pose_is_held.push_back(image.is_held ? 1 : 0);
    if (image.is_separator) terms.separators.push_back({SeparatorId::Kind::kPose, image.id.value});
  }
}

void AddPoint(const Track& track, uint32_t id, BundleSubproblem& terms) {
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

void AddPriors(const Subproblem& subproblem, BundleSubproblem& terms) {
  for (const SubproblemBias& bias : subproblem.biases) {
    terms.bias_ids.push_back(bias.group);
    terms.problem.bias_sigma_m.push_back(bias.sigma_m);
    if (bias.is_separator) terms.separators.push_back({SeparatorId::Kind::kBias, bias.group});
  }
  for (const SubproblemPrior& prior : subproblem.priors) {
    PositionPrior& term = terms.problem.position_priors.emplace_back();
    term.pose = PositionOf(terms.pose_ids, prior.image.value);
    term.position_in_world = prior.position_in_world;
    term.sigma_m = prior.sigma_m;
    if (prior.bias_group) term.bias_group = PositionOf(terms.bias_ids, *prior.bias_group);
  }
  for (const SubproblemDirection& direction : subproblem.directions) {
    terms.problem.direction_priors.push_back(
        {.pose = PositionOf(terms.pose_ids, direction.image.value),
         .direction_in_world = direction.direction_in_world,
         .direction_in_cam = direction.direction_in_cam,
         .sigma_rad = direction.sigma_rad});
  }
}

/// The distance is a matter of the subproblem that holds both ends of it.
void AddGauge(const Subproblem& subproblem, BundleSubproblem& terms) {
  if (!subproblem.farthest) return;
  const auto held = std::ranges::find_if(subproblem.images, &SubproblemImage::is_held);
  terms.gauge.anchor = PositionOf(terms.pose_ids, held->id.value);
  terms.gauge.farthest = PositionOf(terms.pose_ids, subproblem.farthest->value);
}

}  // namespace

BundleSubproblem TermsOf(const Subproblem& subproblem) {
  BundleSubproblem terms;
  AddPoses(subproblem, terms);
  AddPriors(subproblem, terms);
  for (const SplitTrack& track : subproblem.split) {
    AddPoint(track.part, track.id, terms);
    terms.separators.push_back({SeparatorId::Kind::kPoint, track.id});
  }
  uint32_t next = kFirstInnerPoint;
  for (const Track& track : subproblem.scene.tracks) AddPoint(track, next++, terms);
  AddGauge(subproblem, terms);
  return terms;
}

Subproblem WithState(Subproblem subproblem, const BundleState& state) {
  size_t pose = 0;
  for (const SubproblemImage& image : subproblem.images) {
    RegisteredImage& registered = subproblem.scene.images.at(image.id);
    if (registered.loose) continue;
    const PoseState& now = state.poses[pose++];
    if (!image.is_held) registered.cam_from_world = Rigid3::FromCentre(now.rotation, now.centre);
  }
  for (size_t i = 0; i < subproblem.biases.size(); ++i)
    subproblem.biases[i].value_m = state.biases[i];
  size_t point = 0;
  for (SplitTrack& track : subproblem.split) track.part.point_in_world = state.points[point++];
  for (Track& track : subproblem.scene.tracks) track.point_in_world = state.points[point++];
  return subproblem;
}

}  // namespace orbweave
