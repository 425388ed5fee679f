// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/submit_command.h"

#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "cli/coordinator_argument.h"
#include "cli/exit_code.h"
#include "cli/fail_on_argument.h"
#include "cli/format_summary.h"
#include "cli/image_arguments.h"
#include "cli/option_arguments.h"
#include "cli/progress_bar.h"
#include "cli/root_argument.h"
#include "cli/stop_signals.h"
#include "cli/wait_for_job.h"
#include "cli/write_outputs.h"
#include "core/io/file.h"
#include "stages/prepare_job.h"

namespace orbweave {
namespace {

struct SubmitArguments {
  CoordinatorArgument coordinator{};
  std::map<std::string, std::string> roots{};
  ScanRequest scan{};
  std::string clusters{};
  std::string output{};
  FailOn fail_on{};
  OptionArguments options{};
};

absl::Status WaitAndWrite(ClientApi& coordinator,
                          const Digest& job,
                          const SubmitArguments& arguments,
                          const std::stop_token& stop) {
  ProgressBar bar(stderr);
  const auto show = [&bar](const JobStatus& status) { bar.Update(status); };
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus status, WaitForJob(coordinator, job, show, {}, stop));
  bar.Finish();
  if (status.state != JobState::kDone)
    return absl::InternalError("the job did not finish: " + status.error);
  ORBWEAVE_ASSIGN_OR_RETURN(const JobReport report,
                            WriteOutputs(coordinator, status, arguments.output));
  std::fputs(FormatSummary(report, arguments.output).c_str(), stdout);
  return CheckVerdict(report.verdict, arguments.fail_on);
}

absl::Status Submit(const SubmitArguments& arguments) {
  const StopSignals signals;
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, ReadOptions(arguments.options));
  if (!arguments.output.empty()) ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(arguments.output));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto coordinator,
      Connect(arguments.coordinator,
              {.patience_s = kJobPatience_s, .stop = signals.token(), .roots = arguments.roots}));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const JobSpec spec,
      PrepareImageJob(
          *coordinator, arguments.scan, arguments.clusters, options, {.stop = signals.token()}));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest job, coordinator->SubmitJob(spec));
  if (!arguments.output.empty()) return WaitAndWrite(*coordinator, job, arguments, signals.token());
  std::printf("%s\n", job.ToHex().c_str());
  return absl::OkStatus();
}

}  // namespace

void AddSubmitCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command =
      app.add_subcommand("submit", "Have a running coordinator reconstruct a folder of panoramas");
  const auto arguments = std::make_shared<SubmitArguments>();
  AddCoordinatorArgument(*command, arguments->coordinator);
  AddRootArgument(*command,
                  arguments->roots,
                  "Where a root of the coordinator is on this machine: images beneath it are not "
                  "sent, the coordinator reads them itself (repeatable)");
  AddImageArguments(*command, arguments->scan);
  AddHeightArgument(*command, arguments->options);
  AddClustersArgument(*command, arguments->clusters);
  CLI::Option* output = command->add_option(
      "--output",
      arguments->output,
      "Wait for the end and write the results here (default: print the job's id and leave)");
  AddFailOnArgument(*command, arguments->fail_on)->needs(output);
  AddOptionArguments(*command, arguments->options);
  command->footer(
      "Examples:\n"
      "  orbweave serve --listen 127.0.0.1:7000 --state state &\n"
      "  orbweave work --join 127.0.0.1:7000 --slots 2 &\n"
      "  orbweave submit --coordinator 127.0.0.1:7000 street/images --gnss street/gnss.csv "
      "--output model\n"
      "The same command after an interruption joins the job, or collects its results.");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(Submit(*arguments)); };
  });
}

}  // namespace orbweave
