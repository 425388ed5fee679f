// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/growth/start_globally.h"

#include <algorithm>

#include "core/mapping/adjustment/adjust_part.h"
#include "core/mapping/model/filter_points.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/positioning/place_by_pairs.h"
#include "core/mapping/positioning/place_by_positions.h"
#include "core/mapping/registration/register_image.h"

namespace orbweave {
namespace {

/// Centres from pairs are good to some hundredths of a step: points are first made under limits so
/// many times as wide.
constexpr double kSlackOfPairs = 4.0;
/// Wider limits let in points of the next house: of nine streets with houses that repeat, 10 and
/// 12 m a step, two came to a model 7 and 9 m off from right positions with 4, and none with 2.
constexpr double kSlackOfPositions = 2.0;
/// What positions have wrong in common cancels in steps, by which their exactness is measured, and
/// not in positions.
constexpr double kLeastFactor = 0.2;

/// Images that see less of the model than registration demands.
std::vector<ImageSlot> FindUnsupported(const MappingState& state, const MappingOptions& options) {
  const RegistrationLimits limits = {.min_inliers = options.min_inliers};
  std::vector<ImageSlot> unsupported;
  for (const ImageSlot image : state.Registered()) {
    if (state.NumObservations(image) < NeededInliers(limits, state.Visible(image).Count())) {
      unsupported.push_back(image);
    }
  }
  return unsupported;
}

void TriangulateAll(MappingState& state, const TrackLimits& limits) {
  for (const ImageSlot image : state.Registered()) TriangulateImage(state, image, limits);
}

/// StartGlobally from poses that are good enough to make points under limits `slack` as wide.
absl::StatusOr<bool> StartFrom(const PairPlacement& placement,
                               double slack,
                               MappingState& state,
                               const MappingOptions& options,
                               const StageContext& context) {
  if (placement.position_factor)
    state.SetInEnu(std::max(*placement.position_factor, kLeastFactor), placement.height_offset_m);
  for (size_t i = 0; i < placement.images.size(); ++i) {
    state.Register(placement.images[i], placement.cams_from_world[i]);
  }
  const TrackLimits limits = LimitsOf(options);
  TriangulateAll(
      state, {.max_error_px = slack * limits.max_error_px, .min_angle_deg = limits.min_angle_deg});
  const BundleOptions how = {
      .loss = BundleLoss::kCauchy, .max_iterations = 20, .function_tolerance = 1e-3};
  ORBWEAVE_RETURN_IF_ERROR(
      AdjustPart(state, state.Registered(), AllPoints(state), how, context).status());
  for (const PointIndex point : AllPoints(state)) state.RemovePoint(point);
  TriangulateAll(state, limits);
  for (const ImageSlot image : FindUnsupported(state, options)) state.Deregister(image);
  return state.Registered().size() >= static_cast<size_t>(options.min_component_images);
}

}  // namespace

absl::StatusOr<bool> StartGlobally(MappingState& state,
                                   std::span<const uint8_t> available,
                                   const MappingOptions& options,
                                   const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const PairPlacement placement,
      PlaceByPairs(state.Problem(), state.Graph(), available, options, context));
  return StartFrom(placement, kSlackOfPairs, state, options, context);
}

absl::StatusOr<bool> StartOnPositions(MappingState& state,
                                      std::span<const uint8_t> available,
                                      const MappingOptions& options,
                                      const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const PairPlacement placement,
      PlaceByPositions(state.Problem(), state.Graph(), available, options, context));
  if (placement.images.empty()) return false;
  return StartFrom(placement, kSlackOfPositions, state, options, context);
}

}  // namespace orbweave
