// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/pipeline/coordinator_api.h"

namespace orbweave {

/// "running", "done", "failed" or "cancelled".
[[nodiscard]] std::string_view JobStateName(JobState state);

/// A job as lines for people: one for the job, one per stage, one for the workers.
[[nodiscard]] std::string FormatJobStatus(const JobStatus& status);

/// A job as one JSON object, all of JobStatus by name.
[[nodiscard]] std::string JobStatusToJson(const JobStatus& status);

}  // namespace orbweave
