// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/judge_by_gnss.h"

#include <algorithm>

#include "core/mapping/registration/pose_of_most_places.h"
#include "core/mapping/registration/pose_on_gnss_steps.h"
#include "core/mapping/registration/step_witness.h"

namespace orbweave {
namespace {

// Found on streets of rendered houses that repeat (docs/hard_cases.md): of images put a house too
// far along, 3 to 66 % of the visible points agreed, in 3 to 19 places; of images that stood right
// and had a wrong position, 36 to 72 % in 14 to 36 places.
constexpr double kClear = 0.75;
constexpr size_t kManyPlaces = 20;
/// In fewer all points may be of one facade, and it a likeness.
constexpr size_t kFewPlaces = 4;
constexpr double kUnclear = 0.33;

constexpr double kManySigmas = 6.0;

bool ArePointsAtOne(const MappingState& state,
                    ImageSlot image,
                    const Rigid3& found,
                    const SceneCorrespondences& correspondences,
                    double max_error_rad) {
  const PlaceCount places = CountPlaces(found, correspondences, max_error_rad);
  if (places.agreeing >= kManyPlaces && 2 * places.agreeing >= places.seen) return true;
  const double visible = state.Visible(image).Count();
  return places.agreeing >= kFewPlaces &&
         SupportOf(found, correspondences, max_error_rad).count >= kClear * visible;
}

bool IsFarOff(const MappingState& state, ImageSlot image, double misfit) {
  return state.Problem().images[image].is_position_of_drive && misfit > kManySigmas;
}

bool IsOneAroundContradicted(const MappingState& state, const StepWitness& gnss) {
  return std::ranges::any_of(gnss.Witnesses(), [&](ImageSlot image) {
    return StepWitness(state, image).Contradicts(state.Centre(image));
  });
}

}  // namespace

GnssVerdict JudgeByGnss(const MappingState& state,
                        ImageSlot image,
                        const Rigid3& found,
                        const SceneCorrespondences& correspondences,
                        double max_error_rad) {
  if (ArePointsAtOne(state, image, found, correspondences, max_error_rad)) return {};
  const StepWitness gnss(state, image);
  if (!gnss.Contradicts(found.Centre())) return {};
  GnssVerdict verdict{.opinion = GnssOpinion::kContradicted};
  verdict.better = PoseOnGnssSteps(state, image, gnss, found, correspondences, max_error_rad);
  const double visible = state.Visible(image).Count();
  const uint32_t agreeing = SupportOf(found, correspondences, max_error_rad).count;
  if (!verdict.better && (agreeing < kUnclear * visible || IsOneAroundContradicted(state, gnss) ||
                          IsFarOff(state, image, *gnss.Misfit(found.Centre()))))
    verdict.opinion = GnssOpinion::kRefused;
  return verdict;
}

bool IsGrosslyContradicted(const MappingState& state,
                           ImageSlot image,
                           const Rigid3& found,
                           const SceneCorrespondences& correspondences,
                           double max_error_rad) {
  if (!state.Problem().images[image].is_position_of_drive ||
      ArePointsAtOne(state, image, found, correspondences, max_error_rad))
    return false;
  return IsFarOff(state, image, StepWitness(state, image).Misfit(found.Centre()).value_or(0.0));
}

}  // namespace orbweave
