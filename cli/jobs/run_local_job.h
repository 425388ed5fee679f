// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "cli/arguments/fail_on_argument.h"
#include "cli/arguments/fleet_argument.h"
#include "cli/process/stop_signals.h"
#include "core/base/stage_context.h"
#include "core/pipeline/coordinator_api.h"

namespace orbweave {

struct LocalJob {
  std::string output{};  ///< folder of the results; its state is in output/.orbweave
  FleetArgument fleet{};
  FailOn fail_on{};     ///< of the verdict
  bool is_last = true;  ///< else workers that joined are not sent home: another job follows
  /// Makes the job's inputs known to the coordinator and describes it.
  std::function<absl::StatusOr<JobSpec>(ClientApi&, const StageContext&)> prepare{};
  /// What becomes of the job that has ended, however. Empty: WriteJob.
  std::function<absl::Status(ClientApi&, const JobStatus&)> conclude{};
};

/// Runs one job with a coordinator in this process and worker processes on this machine, shows its
/// progress on stderr and concludes it. Ctrl-C stops it cleanly; run again it goes on where it was.
/// SIGTERM too (StoppedError), but workers that joined are not sent home then: an engine will start
/// it again. Codes of WriteJob.
[[nodiscard]] absl::Status RunLocalJob(const LocalJob& job, const StopSignals& signals);

}  // namespace orbweave
