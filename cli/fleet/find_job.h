// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/pipeline/job_api.h"

namespace orbweave {

/// The job whose id is, or begins with, `prefix` (hexadecimal digits). NotFound: none;
/// InvalidArgument: several; else the codes of GetJob and ListJobs.
[[nodiscard]] absl::StatusOr<JobStatus> FindJob(JobApi& coordinator, const std::string& prefix);

}  // namespace orbweave
