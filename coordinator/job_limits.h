// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/status.h"
#include "core/pipeline/job_api.h"

namespace orbweave {

/// Whether a job's description is of a size that no few of them fill the list of all, which is one
/// message: a label of 1 KiB at most, options of 16 KiB (all there are take 10), a kind of 64
/// bytes, 64 inputs. InvalidArgument says what is too long.
[[nodiscard]] absl::Status CheckSizeOf(const JobSpec& spec);

}  // namespace orbweave
