// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/reconsider_images.h"

#include <algorithm>
#include <vector>

#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/model/triangulate_tracks.h"
#include "core/mapping/registration/pair_witness.h"
#include "core/mapping/registration/pose_of_most_places.h"
#include "core/mapping/registration/pose_on_gnss_steps.h"
#include "core/mapping/registration/scene_correspondences.h"

namespace orbweave {
namespace {

/// Two images may have to change places; one that has no right place would go round for ever.
constexpr int kMaxReconsidered = 2;

/// Correspondences with points that two other images hold: what they say is not the image's own
/// opinion of where it is.
SceneCorrespondences HeldByOthers(const MappingState& state, ImageSlot image) {
  const SceneCorrespondences all = FindSceneCorrespondences(state, image);
  SceneCorrespondences held;
  for (size_t i = 0; i < all.size(); ++i) {
    const auto others = std::ranges::count_if(state.Point(all.points[i]).nodes, [&](Node node) {
      return state.Graph().image_of_node[node] != image;
    });
    if (others < 2) continue;
    held.nodes.push_back(all.nodes[i]);
    held.points.push_back(all.points[i]);
    held.bearings.push_back(all.bearings[i]);
    held.positions.push_back(all.positions[i]);
  }
  return held;
}

/// Whether a strong pair speaks against where the image is, or points in clearly more places for
/// another length of its steps, or GNSS with some of them.
bool IsDoubted(const MappingState& state, ImageSlot image, double max_error_px) {
  const double max_error_rad = state.Problem().images[image].camera.AngleFromPixels(max_error_px);
  const Rigid3& pose = state.CamFromWorld(image);
  const std::vector<ViewMatches> views = MatchesWithRegistered(state, image);
  if (ContradictsStrongPair(pose, views, max_error_rad)) return true;
  const SceneCorrespondences held = HeldByOthers(state, image);
  const Rigid3 other = PoseOfMostPlaces(pose, held, views, max_error_rad);
  if (HasClearlyMorePlaces(other, pose, held, max_error_rad)) return true;
  return PoseOnGnssSteps(state, image, StepWitness(state, image), pose, held, max_error_rad)
      .has_value();
}

/// Whether GNSS speaks for the centre before, clearly.
bool IsFurtherOff(const StepWitness& gnss,
                  const Eigen::Vector3d& now,
                  const Eigen::Vector3d& before) {
  const std::optional<double> misfit = gnss.Misfit(now);
  return misfit && !gnss.Supports(now) && *misfit > *gnss.Misfit(before) + 1.0;
}

}  // namespace

absl::Status ReconsiderImages(MappingState& state,
                              const MappingOptions& options,
                              const RegistrationLimits& limits,
                              RegistrationLog& log,
                              const StageContext& context) {
  const std::vector<ImageSlot> registered = state.Registered();
  for (const ImageSlot image : registered) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    if (log[image].num_reconsidered >= kMaxReconsidered ||
        !IsDoubted(state, image, limits.max_error_px)) {
      continue;
    }
    ++log[image].num_reconsidered;
    const Rigid3 before = state.CamFromWorld(image);
    state.Deregister(image);
    ORBWEAVE_ASSIGN_OR_RETURN(const RegistrationAttempt attempt,
                              RegisterImage(state, image, limits, context));
    if (!attempt.registered) {
      state.Register(image, before);
    } else if (IsFurtherOff(StepWitness(state, image), state.Centre(image), before.Centre())) {
      state.SetPose(image, before);
    }
    TriangulateImage(state, image, LimitsOf(options));
  }
  return absl::OkStatus();
}

}  // namespace orbweave
