// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/report/job_results.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// "look_alikes": how many verified pairs join places that only look alike, as the sequence of a
/// drive (DropEdgesAgainstChain) or GNSS (DropEdgesAgainstGnss) shows; the models are made without
/// them. Good, however many: what is left of
/// them shows in pairs that contradict the model.
[[nodiscard]] CrossCheck CheckLookAlikes(const JobResults& results);

}  // namespace orbweave
