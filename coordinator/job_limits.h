// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/status.h"
#include "core/pipeline/job_api.h"
#include "core/pipeline/task.h"

namespace orbweave {

/// Whether a job's description is of a size that its status is far from filling a message: a label
/// of 1 KiB at most, options of 16 KiB (all there are take 10), a kind of 64 bytes, 64 inputs; and
/// its traceparent one. InvalidArgument says what is too long or no traceparent.
[[nodiscard]] absl::Status CheckSizeOf(const JobSpec& spec);

/// Whether a result is of a size that a message holds, with what is said beside it: a report of
/// 1 MiB at most, 200,000 blobs. InvalidArgument says what is too large.
[[nodiscard]] absl::Status CheckSizeOf(const TaskResult& result);

/// The same error with the first 4,000 bytes of its text at most.
[[nodiscard]] absl::Status Shortened(const absl::Status& error);

}  // namespace orbweave
