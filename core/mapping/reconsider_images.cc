// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/reconsider_images.h"

#include <vector>

#include "core/mapping/mapping_schedule.h"
#include "core/mapping/pair_witness.h"
#include "core/mapping/triangulate_tracks.h"

namespace orbweave {
namespace {

/// Two images may have to change places; one that has no right place would go round for ever.
constexpr int kMaxReconsidered = 2;

bool IsContradicted(const MappingState& state, ImageSlot image, double max_error_px) {
  return ContradictsStrongPair(state.CamFromWorld(image),
                               MatchesWithRegistered(state, image),
                               state.Problem().images[image].camera.AngleFromPixels(max_error_px));
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
        !IsContradicted(state, image, limits.max_error_px)) {
      continue;
    }
    ++log[image].num_reconsidered;
    const Rigid3 before = state.CamFromWorld(image);
    state.Deregister(image);
    ORBWEAVE_ASSIGN_OR_RETURN(const RegistrationAttempt attempt,
                              RegisterImage(state, image, limits, context));
    if (!attempt.registered) state.Register(image, before);
    TriangulateImage(state, image, LimitsOf(options));
  }
  return absl::OkStatus();
}

}  // namespace orbweave
