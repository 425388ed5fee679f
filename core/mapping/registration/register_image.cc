// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/register_image.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/base/random.h"
#include "core/estimators/estimate_absolute_pose.h"
#include "core/mapping/registration/judge_by_gnss.h"
#include "core/mapping/registration/pair_witness.h"
#include "core/mapping/registration/pose_from_pairs.h"
#include "core/mapping/registration/pose_of_most_places.h"
#include "core/mapping/registration/scene_correspondences.h"
#include "core/mapping/registration/step_witness.h"

namespace orbweave {
namespace {

/// The stage's context with a seed of the image's own, so that the order of registration does not
/// change what an image draws.
StageContext ContextOf(const StageContext& context, ImageId image) {
  StageContext own = context;
  own.report = {};
  own.seed = Random(context.seed ^ (uint64_t{image.value} << 20)).Next();
  return own;
}

/// The pose that a pair proposes, and neither a strong pair nor GNSS contradicts, with which points
/// in most places of the image agree: where these are more than agree with `found`, which strong
/// pairs contradict.
std::optional<Rigid3> PoseOfPairsAndPlaces(const MappingState& state,
                                           ImageSlot image,
                                           const Rigid3& found,
                                           const SceneCorrespondences& correspondences,
                                           std::span<const ViewMatches> views,
                                           double max_error_rad) {
  const StepWitness gnss(state, image);
  const auto is_contradicted = [&](const Rigid3& pose) {
    return gnss.Contradicts(pose.Centre()) || ContradictsStrongPair(pose, views, max_error_rad);
  };
  std::vector<Rigid3> candidates = PosesOfPairs(state, image, correspondences);
  std::erase_if(candidates, is_contradicted);
  std::optional<Rigid3> best = CandidateOfMostPlaces(candidates, correspondences, max_error_rad);
  const auto places = [&](const Rigid3& pose) {
    return CountPlaces(pose, correspondences, max_error_rad).agreeing;
  };
  if (!best || is_contradicted(*best) || places(*best) <= places(found)) return std::nullopt;
  return best;
}

}  // namespace

uint32_t NeededInliers(const RegistrationLimits& limits, uint32_t num_visible) {
  return static_cast<uint32_t>(std::max<double>(
      limits.min_inliers, std::ceil(limits.min_inlier_share * static_cast<double>(num_visible))));
}

absl::StatusOr<RegistrationAttempt> RegisterImage(MappingState& state,
                                                  ImageSlot image,
                                                  const RegistrationLimits& limits,
                                                  const StageContext& context) {
  const ClusterImage& problem_image = state.Problem().images[image];
  const double max_error_rad = problem_image.camera.AngleFromPixels(limits.max_error_px);
  const SceneCorrespondences correspondences = FindSceneCorrespondences(state, image);
  const std::vector<ViewMatches> views = MatchesWithRegistered(state, image);
  RegistrationAttempt attempt{.num_visible = state.Visible(image).Count()};
  const uint32_t needed = NeededInliers(limits, attempt.num_visible);

  const auto place = [&](const Rigid3& cam_from_world) {
    if (limits.heeds_pairs &&
        IsGrosslyContradicted(state, image, cam_from_world, correspondences, max_error_rad)) {
      attempt.waits = true;
      return false;
    }
    state.Register(image, cam_from_world);
    return true;
  };
  const auto accept = [&](const Rigid3& cam_from_world, uint32_t fewest) {
    const PoseSupport support = SupportOf(cam_from_world, correspondences, max_error_rad);
    attempt.num_inliers = std::max(attempt.num_inliers, support.count);
    if (support.count < fewest) return false;
    if (limits.propose_from_pairs &&
        !IsLengthTold(cam_from_world, correspondences, views, max_error_rad)) {
      attempt.obstacle = RegistrationObstacle::kLength;
      return false;  // so few points may all be far
    }
    return place(cam_from_world);
  };

  ORBWEAVE_ASSIGN_OR_RETURN(std::optional<AbsolutePose> pose,
                            EstimateAbsolutePose(correspondences.bearings,
                                                 correspondences.positions,
                                                 max_error_rad,
                                                 {.min_inliers = 6},
                                                 ContextOf(context, problem_image.id)));
  if (pose && limits.heeds_pairs) {
    pose->cam_from_world =
        PoseOfMostPlaces(pose->cam_from_world, correspondences, views, max_error_rad);
  }
  if (pose && limits.heeds_pairs) {
    const GnssVerdict gnss =
        JudgeByGnss(state, image, pose->cam_from_world, correspondences, max_error_rad);
    attempt.waits =
        !gnss.better && (gnss.opinion == GnssOpinion::kRefused ||
                         (gnss.opinion == GnssOpinion::kContradicted && limits.waits_for_gnss));
    // What most points say is then known to be wrong: it is not asked how many these are.
    if (gnss.better)
      attempt.registered = accept(*gnss.better, static_cast<uint32_t>(limits.min_inliers));
    if (attempt.waits) {
      attempt.num_inliers = SupportOf(pose->cam_from_world, correspondences, max_error_rad).count;
    }
    if (gnss.better || attempt.waits) return attempt;
  }
  const bool is_doubtful = pose && limits.heeds_pairs &&
                           ContradictsStrongPair(pose->cam_from_world, views, max_error_rad);
  if (is_doubtful) {
    const std::optional<Rigid3> other = PoseOfPairsAndPlaces(
        state, image, pose->cam_from_world, correspondences, views, max_error_rad);
    // What most points say is then known to be wrong, as by GNSS.
    if (other && accept(*other, static_cast<uint32_t>(limits.min_inliers))) {
      attempt.registered = true;
      return attempt;
    }
    attempt.waits = false;
  }
  std::optional<PoseFromPairs> proposed;
  if (is_doubtful || limits.propose_from_pairs)
    proposed = EstimatePoseFromPairs(state, image, views, correspondences, max_error_rad);
  const auto agreeing = [&](const Rigid3& cam_from_world) {
    return SupportOf(cam_from_world, correspondences, max_error_rad).count +
           CountAgreeingMatches(cam_from_world, views, max_error_rad);
  };
  const bool pairs_know_better =
      is_doubtful && proposed &&
      agreeing(proposed->cam_from_world) > agreeing(pose->cam_from_world);
  if (pose && !pairs_know_better) attempt.registered = accept(pose->cam_from_world, needed);
  if (pairs_know_better) {
    attempt.obstacle = RegistrationObstacle::kPairs;
    attempt.num_inliers = SupportOf(pose->cam_from_world, correspondences, max_error_rad).count;
  }
  if (!attempt.registered && proposed) {
    const bool is_held = IsHeldByPairs(*proposed, static_cast<uint32_t>(limits.min_inliers));
    // What contradicts the points must itself know how long the step is: far points never do.
    attempt.registered =
        (is_held || !pairs_know_better) && accept(proposed->cam_from_world, needed);
    if (!attempt.registered && limits.propose_from_pairs && is_held)
      attempt.registered = place(proposed->cam_from_world);
    if (!is_held && attempt.obstacle == RegistrationObstacle::kNone)
      attempt.obstacle = RegistrationObstacle::kUnheld;
  }
  return attempt;
}

}  // namespace orbweave
