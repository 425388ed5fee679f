// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <string>

#include "cli/commands/bench_command.h"
#include "cli/commands/cancel_command.h"
#include "cli/commands/dense_command.h"
#include "cli/commands/drain_command.h"
#include "cli/commands/evaluate_command.h"
#include "cli/commands/exec_tasks_command.h"
#include "cli/commands/export_command.h"
#include "cli/commands/fetch_command.h"
#include "cli/commands/forget_command.h"
#include "cli/commands/gc_command.h"
#include "cli/commands/inspect_command.h"
#include "cli/commands/jobs_command.h"
#include "cli/commands/keys_command.h"
#include "cli/commands/launch_command.h"
#include "cli/commands/options_command.h"
#include "cli/commands/reconstruct_command.h"
#include "cli/commands/retry_command.h"
#include "cli/commands/run_command.h"
#include "cli/commands/serve_command.h"
#include "cli/commands/status_command.h"
#include "cli/commands/stop_command.h"
#include "cli/commands/store_command.h"
#include "cli/commands/submit_command.h"
#include "cli/commands/synth_command.h"
#include "cli/commands/work_command.h"
#include "cli/process/command.h"
#include "cli/process/exit_code.h"
#include "cli/process/raise_file_limit.h"
#include "cli/process/single_threaded_libraries.h"
#include "core/pipeline/build_version.h"
#include "stages/plans.h"
#include "stages/registry.h"

int main(int argc, char** argv) {
  ::setenv("GRPC_VERBOSITY", "NONE", 0);  // what goes wrong is said in our own words
  orbweave::RunLibrariesOnOneThread(argv);
  orbweave::RaiseFileLimit();
  CLI::App app("Orbweave: structure from motion for 360-degree panoramas, on one machine or many");
  app.name("orbweave");
  app.set_version_flag("--version",
                       [] { return "orbweave " + std::string(orbweave::BuildVersion()); });
  app.require_subcommand(1);
  const orbweave::StageLookup stages = orbweave::FindStageFunction;
  orbweave::SelectedCommand selected;
  orbweave::AddRunCommand(app, selected);
  orbweave::AddReconstructCommand(app, selected);
  orbweave::AddDenseCommand(app, selected);
  orbweave::AddEvaluateCommand(app, selected);
  orbweave::AddExportCommand(app, selected);
  orbweave::AddInspectCommand(app, selected);
  orbweave::AddBenchCommand(app, selected);
  orbweave::AddOptionsCommand(app, selected);
  orbweave::AddSynthCommand(app, selected);
  orbweave::AddKeysCommand(app, selected);
  orbweave::AddServeCommand(app, selected, orbweave::FindJobPlan);
  orbweave::AddWorkCommand(app, selected);
  orbweave::AddExecTasksCommand(app, selected, stages);
  orbweave::AddLaunchCommand(app, selected);
  orbweave::AddSubmitCommand(app, selected);
  orbweave::AddFetchCommand(app, selected);
  orbweave::AddStatusCommand(app, selected);
  orbweave::AddJobsCommand(app, selected);
  orbweave::AddCancelCommand(app, selected);
  orbweave::AddRetryCommand(app, selected);
  orbweave::AddDrainCommand(app, selected);
  orbweave::AddStopCommand(app, selected);
  orbweave::AddForgetCommand(app, selected);
  orbweave::AddGcCommand(app, selected);
  orbweave::AddStoreCommand(app, selected);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? orbweave::kExitOk : orbweave::kExitUsage;
  }
  try {
    return selected.run();
  } catch (const std::exception& error) {  // what bytes of others may bring about, not files alone
    return orbweave::ReportStatus(
        absl::InternalError(std::string("stopped by a fault of this program: ") + error.what()));
  }
}
