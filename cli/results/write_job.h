// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cli/arguments/fail_on_argument.h"
#include "core/pipeline/coordinator_api.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// Writes what a job of any kind left into `folder` and prints a summary on stdout. Internal: the
/// job failed, or nothing could be registered (outputs are written all the same). Cancelled: it was
/// cancelled. FailedPrecondition: it runs. VerdictError: the verdict is as bad as `fail_on`,
/// whatever could be registered. Codes of WriteOutputs and WriteDense.
[[nodiscard]] absl::Status WriteJob(ClientApi& coordinator,
                                    const JobStatus& status,
                                    const std::string& folder,
                                    const FailOn& fail_on = {});

/// The same of a job that left a model on which there is more to do first: its verdict, for
/// CheckVerdict. VerdictError only where nothing could be registered.
[[nodiscard]] absl::StatusOr<Verdict> WriteModel(ClientApi& coordinator,
                                                 const JobStatus& status,
                                                 const std::string& folder,
                                                 const FailOn& fail_on);

}  // namespace orbweave
