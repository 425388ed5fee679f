// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "cli/fail_on_argument.h"
#include "core/base/stage_context.h"
#include "core/pipeline/coordinator_api.h"

namespace orbweave {

struct LocalJob {
  std::string output{};  ///< folder of the results; its state is in output/.orbweave
  uint32_t workers = 2;
  FailOn fail_on{};  ///< of the verdict
  /// Makes the job's inputs known to the coordinator and describes it.
  std::function<absl::StatusOr<JobSpec>(BlobDepot&, const StageContext&)> prepare{};
  /// What becomes of the finished job. Empty: writes the outputs and prints a summary on stdout.
  std::function<absl::Status(ClientApi&, const JobStatus&)> conclude{};
};

/// Runs one job with a coordinator in this process and worker processes on this machine, shows its
/// progress on stderr and concludes it. Ctrl-C stops it cleanly; run again it goes on where it was.
/// Internal: the job failed, or nothing could be registered (outputs are written all the same).
/// VerdictError: the verdict is as bad as `fail_on`.
[[nodiscard]] absl::Status RunLocalJob(const LocalJob& job);

}  // namespace orbweave
