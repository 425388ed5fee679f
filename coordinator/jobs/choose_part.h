// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/jobs/stage_run.h"

namespace orbweave {

/// The ready part of a stage that a worker had better do next in this slot, so that what it reads
/// is near; which part it is changes no result. `alive`: the workers that serve, in order of name.
/// `ahead`: the slot is at work, and the part would wait there for the end of its task. Only parts
/// of a quick stage do, that have not failed before and, in a loop's stage, are at home nowhere
/// else: no other slot would have been the sooner done with it by much.
///
/// Of a loop's stage: the first part that the slot had the last time, whose process may still know
/// it; else one that nobody in `alive` had; else the last part of somebody else.
///
/// Of other stages, where neighbours read much of the same: what failed before, so that it is known
/// soon whether it always does; else the part after the one the worker was given last, whose inputs
/// it may still have; else the begin of the longest stretch of ready parts, or its middle where
/// somebody else works towards it.
///
/// A task that failed here waits for another worker while one that has not failed it is in `alive`.
[[nodiscard]] std::optional<uint32_t> ChoosePart(const StageRun& run,
                                                 const WorkerSlot& at,
                                                 const std::vector<std::string>& alive,
                                                 double now_s,
                                                 bool ahead);

}  // namespace orbweave
