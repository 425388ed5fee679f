// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/slurm/slurm_scripts.h"
#include "core/base/status.h"

namespace orbweave {

/// Makes what was said relative to this folder hold on every node: program, work folder, output and
/// the name in the queue. InvalidArgument: no such path can be.
[[nodiscard]] absl::Status MakeAbsolute(SlurmLaunch& launch);

/// Writes both scripts, and the keys of a fleet of this launch's own, into its folder. Errors of
/// the disk and of MakeKeyStore.
[[nodiscard]] absl::Status WriteLaunch(const SlurmLaunch& launch);

enum class SubmitAnd { kLeave, kWait };

/// Hands the coordinator's script to `sbatch`, whose exit code this is; with kWait that is the
/// job's.
[[nodiscard]] int SubmitLaunch(const SlurmLaunch& launch, SubmitAnd then);

}  // namespace orbweave
