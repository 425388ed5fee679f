// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pipeline/job_api.h"

namespace orbweave {

/// A job as one line: id, state, how far it is, how long it takes, label.
[[nodiscard]] std::string FormatJobLine(const JobStatus& status);

/// A job as lines for people: its line, what went wrong, a table of its stages that have tasks.
[[nodiscard]] std::string FormatJobStatus(const JobStatus& status);

/// A table of workers.
[[nodiscard]] std::string FormatWorkers(const std::vector<WorkerStatus>& workers);

/// A job as one JSON object, all of JobStatus by name.
[[nodiscard]] std::string JobStatusToJson(const JobStatus& status);

/// The same of workers: an object whose "workers" is a list.
[[nodiscard]] std::string WorkersToJson(const std::vector<WorkerStatus>& workers);

}  // namespace orbweave
