// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/start_globally.h"

#include <algorithm>

#include "core/mapping/adjust_part.h"
#include "core/mapping/filter_points.h"
#include "core/mapping/mapping_schedule.h"
#include "core/mapping/place_by_pairs.h"
#include "core/mapping/register_image.h"

namespace orbweave {
namespace {

/// Centres from pairs are good to some hundredths of a step: points are first made under limits so
/// many times as wide.
constexpr double kSlack = 4.0;
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

}  // namespace

absl::StatusOr<bool> StartGlobally(MappingState& state,
                                   std::span<const uint8_t> available,
                                   const MappingOptions& options,
                                   const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const PairPlacement placement,
      PlaceByPairs(state.Problem(), state.Graph(), available, options, context));
  if (placement.position_factor)
    state.SetInEnu(std::max(*placement.position_factor, kLeastFactor), placement.height_offset_m);
  for (size_t i = 0; i < placement.images.size(); ++i) {
    state.Register(placement.images[i], placement.cams_from_world[i]);
  }
  const TrackLimits limits = LimitsOf(options);
  TriangulateAll(
      state, {.max_error_px = kSlack * limits.max_error_px, .min_angle_deg = limits.min_angle_deg});
  const BundleOptions how = {
      .loss = BundleLoss::kCauchy, .max_iterations = 20, .function_tolerance = 1e-3};
  ORBWEAVE_RETURN_IF_ERROR(
      AdjustPart(state, state.Registered(), AllPoints(state), how, context).status());
  for (const PointIndex point : AllPoints(state)) state.RemovePoint(point);
  TriangulateAll(state, limits);
  for (const ImageSlot image : FindUnsupported(state, options)) state.Deregister(image);
  return state.Registered().size() >= static_cast<size_t>(options.min_component_images);
}

}  // namespace orbweave
