// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "coordinator/coordinator.h"

namespace orbweave {

/// Opens the state of a job that ran into the folder `output`, without workers, and the object
/// store that it had. NotFound: no job ran there; FailedPrecondition: it runs now; errors of
/// OpenS3Store. `clock` outlives the coordinator.
[[nodiscard]] absl::StatusOr<std::unique_ptr<Coordinator>> OpenFinished(const std::string& output,
                                                                        const Clock& clock);

/// NotFound: no job ran into the folder `output`.
[[nodiscard]] absl::Status CheckHoldsJob(const std::string& output);

/// The last finished job with a model of a coordinator that was just opened. FailedPrecondition:
/// there is none.
[[nodiscard]] absl::StatusOr<JobStatus> LastFinishedJob(JobApi& coordinator,
                                                        const std::string& output);

}  // namespace orbweave
