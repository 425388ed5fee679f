// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/inspect/inspected_job.h"
#include "cli/inspect/inspection.h"
#include "core/drawing/draw_image.h"

namespace orbweave {

/// One image of a job: its state and why, clusters, observations, residual and sigmas, the pairs it
/// is in, and its features coloured as `colors` says.
[[nodiscard]] absl::StatusOr<Inspection> InspectImageOfJob(InspectedJob& job,
                                                           ImageId image,
                                                           FeatureColors colors);

}  // namespace orbweave
