// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"
#include "core/mapping/registration/register_image.h"
#include "core/mapping/registration/registration_log.h"

namespace orbweave {

/// Registers images anew that a strong pair contradicts (ContradictsStrongPair), or for which
/// points that others hold say another length of a step in clearly more places (PoseOfMostPlaces):
/// along a straight street no pair contradicts an image that went too far. What an image was
/// registered by when the model was small may have been wrong, and the model has since grown points
/// that know better. In order of images. An image that finds no place keeps the one it has; each is
/// looked at twice at most in the life of its log.
[[nodiscard]] absl::Status ReconsiderImages(MappingState& state,
                                            const MappingOptions& options,
                                            const RegistrationLimits& limits,
                                            RegistrationLog& log,
                                            const StageContext& context);

}  // namespace orbweave
