// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/submit_command.h"

#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "cli/arguments/coordinator_argument.h"
#include "cli/arguments/fail_on_argument.h"
#include "cli/arguments/image_arguments.h"
#include "cli/arguments/option_arguments.h"
#include "cli/arguments/root_argument.h"
#include "cli/fleet/wait_for_job.h"
#include "cli/jobs/dense_job.h"
#include "cli/process/exit_code.h"
#include "cli/process/stop_signals.h"
#include "cli/progress/preparation_bar.h"
#include "cli/progress/progress_bar.h"
#include "cli/results/format_summary.h"
#include "cli/results/write_job.h"
#include "coordinator/traceparent.h"
#include "core/io/file.h"
#include "objects/object_place.h"
#include "stages/prepare_job.h"

namespace orbweave {
namespace {

struct SubmitArguments {
  CoordinatorArgument coordinator{};
  std::map<std::string, std::string> roots{};
  ScanRequest scan{};
  std::string database{};  ///< instead of images
  std::string clusters{};
  std::string output{};
  std::string traceparent{};
  bool dense = false;
  FailOn fail_on{};
  OptionArguments options{};
};

absl::StatusOr<JobSpec> Prepare(BlobDepot& coordinator,
                                const SubmitArguments& arguments,
                                const PipelineOptions& options,
                                const StageContext& context) {
  const ScanRequest& scan = arguments.scan;
  if (arguments.database.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const ImagePlaces places, OpenImagePlaces(scan));
    return PrepareImageJob(coordinator, places, scan, arguments.clusters, options, context);
  }
  return PrepareDatabaseJob(
      coordinator, arguments.database, scan.gnss_table, arguments.clusters, options, context);
}

absl::StatusOr<JobSpec> PrepareShowingProgress(BlobDepot& coordinator,
                                               const SubmitArguments& arguments,
                                               const PipelineOptions& options,
                                               const StopSignals& signals) {
  PreparationBar bar(stderr);
  const auto show = [&bar](const Progress& progress) { bar.Update(progress); };
  return Prepare(coordinator, arguments, options, {.stop = signals.token(), .report = show});
}

absl::StatusOr<JobStatus> Wait(ClientApi& coordinator,
                               const Digest& job,
                               const std::stop_token& stop) {
  ProgressBar bar(stderr);
  const auto show = [&bar](const JobStatus& status) { bar.Update(status); };
  absl::StatusOr<JobStatus> status = WaitForJob(coordinator, job, show, {}, stop);
  bar.Finish();
  return status;
}

absl::Status WaitAndWriteCloud(ClientApi& coordinator,
                               const JobStatus& sparse,
                               const SubmitArguments& arguments,
                               const PipelineOptions& options,
                               const std::stop_token& stop) {
  ORBWEAVE_ASSIGN_OR_RETURN(JobSpec spec, DenseJobOf(coordinator, sparse, options));
  spec.traceparent = arguments.traceparent;
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest dense, coordinator.SubmitJob(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus cloud, Wait(coordinator, dense, stop));
  return WriteJob(coordinator, cloud, arguments.output + "/dense");
}

absl::Status WaitAndWrite(ClientApi& coordinator,
                          const Digest& job,
                          const SubmitArguments& arguments,
                          const PipelineOptions& options,
                          const std::stop_token& stop) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus sparse, Wait(coordinator, job, stop));
  ORBWEAVE_ASSIGN_OR_RETURN(const Verdict verdict,
                            WriteModel(coordinator, sparse, arguments.output, arguments.fail_on));
  if (arguments.dense) {
    ORBWEAVE_RETURN_IF_ERROR(WaitAndWriteCloud(coordinator, sparse, arguments, options, stop));
    std::fputs(FormatVerdict(verdict).c_str(), stdout);
  }
  return CheckVerdict(verdict, arguments.fail_on);
}

absl::Status Submit(const SubmitArguments& arguments) {
  const StopSignals signals;
  if (!arguments.traceparent.empty())
    ORBWEAVE_RETURN_IF_ERROR(ParseTraceparent(arguments.traceparent).status());
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, ReadOptions(arguments.options));
  if (!arguments.output.empty()) ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(arguments.output));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto coordinator,
      Connect(arguments.coordinator,
              {.patience_s = kJobPatience_s, .stop = signals.token(), .roots = arguments.roots}));
  ORBWEAVE_ASSIGN_OR_RETURN(JobSpec spec,
                            PrepareShowingProgress(*coordinator, arguments, options, signals));
  spec.traceparent = arguments.traceparent;
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest job, coordinator->SubmitJob(spec));
  if (!arguments.output.empty())
    return WaitAndWrite(*coordinator, job, arguments, options, signals.token());
  std::printf("%s\n", job.ToHex().c_str());
  return absl::OkStatus();
}

}  // namespace

void AddSubmitCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command =
      app.add_subcommand("submit", "Have a running coordinator reconstruct panoramas");
  const auto arguments = std::make_shared<SubmitArguments>();
  AddCoordinatorArgument(*command, arguments->coordinator);
  AddRootArgument(*command,
                  arguments->roots,
                  "Where a root of the coordinator is on this machine: images beneath it are not "
                  "sent, the coordinator reads them itself (repeatable)");
  AddImageArguments(*command, arguments->scan);
  CLI::Option* const images = command->get_option("IMAGES")->required(false);
  CLI::Option* const database = command->add_option(
      "--database", arguments->database, "Instead of images: a COLMAP or SphereSfM database");
  database->excludes(images);
  AddHeightArgument(*command, arguments->options);
  AddClustersArgument(*command, arguments->clusters);
  CLI::Option* output = command->add_option(
      "--output",
      arguments->output,
      "Wait for the end and write the results here (default: print the job's id and leave)");
  command
      ->add_flag(
          "--dense", arguments->dense, "Then compute the dense cloud as well, into OUTPUT/dense")
      ->needs(output)
      ->excludes(database);
  AddFailOnArgument(*command, arguments->fail_on)->needs(output);
  command
      ->add_option("--traceparent",
                   arguments->traceparent,
                   "The span that asks for it (W3C Trace Context), as parent of the job's spans "
                   "where the coordinator sends them (serve --otlp)")
      ->envname("TRACEPARENT");
  AddOptionArguments(*command, arguments->options);
  command->footer(
      "Examples:\n"
      "  orbweave serve --listen 127.0.0.1:7000 --state state &\n"
      "  orbweave work --join 127.0.0.1:7000 --slots 2 &\n"
      "  orbweave submit --coordinator 127.0.0.1:7000 street/images --gnss street/gnss.csv "
      "--output model\n"
      "  orbweave submit --coordinator 127.0.0.1:7000 --database street.db --output model\n"
      "  orbweave submit --coordinator 127.0.0.1:7000 "
      "'s3://city-images/2026/north?region=eu-central-1' --store-keys reader.keys --output model\n"
      "Objects are read here, for their names and headers; the workers read them from the "
      "store where the coordinator has it as a root (serve --root NAME=s3://...), else they are "
      "read again and sent.\n"
      "The same command after an interruption joins the job, or collects its results.");
  command->callback([arguments, images, database, &selected] {
    if (images->empty() && database->empty()) throw CLI::RequiredError("IMAGES or --database");
    if (images->empty() && IsS3Address(arguments->scan.gnss_table))
      throw CLI::ValidationError("--gnss", "with --database it is a file, not an object");
    selected.run = [arguments] { return ReportStatus(Submit(*arguments)); };
  });
}

}  // namespace orbweave
