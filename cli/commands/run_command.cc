// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/run_command.h"

#include <cstdio>
#include <memory>
#include <string>

#include "cli/arguments/fail_on_argument.h"
#include "cli/arguments/fleet_argument.h"
#include "cli/arguments/image_arguments.h"
#include "cli/arguments/option_arguments.h"
#include "cli/jobs/dense_job.h"
#include "cli/jobs/run_local_job.h"
#include "cli/process/exit_code.h"
#include "cli/results/format_summary.h"
#include "cli/results/write_job.h"
#include "objects/object_place.h"
#include "stages/prepare_job.h"

namespace orbweave {
namespace {

struct RunArguments {
  ScanRequest scan{};
  std::string clusters{};
  std::string output{};
  FleetArgument fleet{};
  bool dense = false;
  FailOn fail_on{};
  OptionArguments options{};
};

absl::Status Run(const RunArguments& arguments) {
  const StopSignals signals;
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, ReadOptions(arguments.options));
  ORBWEAVE_ASSIGN_OR_RETURN(const ImagePlaces places, OpenImagePlaces(arguments.scan));
  Verdict verdict;
  const auto conclude = [&](ClientApi& coordinator, const JobStatus& status) -> absl::Status {
    ORBWEAVE_ASSIGN_OR_RETURN(verdict,
                              WriteModel(coordinator, status, arguments.output, arguments.fail_on));
    return absl::OkStatus();
  };
  const LocalJob sparse{
      .output = arguments.output,
      .fleet = arguments.fleet,
      .is_last = !arguments.dense,
      .prepare =
          [&](BlobDepot& coordinator, const StageContext& context) {
            return PrepareImageJob(
                coordinator, places, arguments.scan, arguments.clusters, options, context);
          },
      .conclude = conclude};
  ORBWEAVE_RETURN_IF_ERROR(RunLocalJob(sparse, signals));
  if (arguments.dense) {
    ORBWEAVE_RETURN_IF_ERROR(RunDenseJob(arguments.output, arguments.fleet, options, signals));
    std::fputs(FormatVerdict(verdict).c_str(), stdout);
  }
  return CheckVerdict(verdict, arguments.fail_on);
}

}  // namespace

void AddRunCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command =
      app.add_subcommand("run", "Reconstruct a folder of panoramas on this machine");
  const auto arguments = std::make_shared<RunArguments>();
  AddImageArguments(*command, arguments->scan);
  AddHeightArgument(*command, arguments->options);
  AddClustersArgument(*command, arguments->clusters);
  command
      ->add_option(
          "--output", arguments->output, "Folder of the results; run again with it to go on")
      ->required();
  AddFleetArguments(*command, arguments->fleet);
  command->add_flag(
      "--dense", arguments->dense, "Then compute the dense cloud as well, into OUTPUT/dense");
  AddFailOnArgument(*command, arguments->fail_on);
  AddOptionArguments(*command, arguments->options);
  command->footer(
      "Examples:\n"
      "  orbweave run street/images --output street/model --gnss street/gnss.csv --masks "
      "street/masks\n"
      "  orbweave run flat --output flat_model --workers 4 --set features.max_features=4096\n"
      "  orbweave run street/images --output model --workers 0 --listen 0.0.0.0:0 --tls "
      "keys/coordinator --announce model.json\n"
      "  orbweave run 's3://city-images/2026/north?region=eu-central-1' --store-keys reader.keys "
      "--output model\n"
      "  orbweave run street/images --output model --store "
      "'s3://city-blobs/model?region=eu-central-1' --store-keys store.keys\n"
      "Ctrl-C stops cleanly; the same command goes on where it was. Workers that joined by "
      "--listen "
      "are sent home at the end, and not when an engine stops it by SIGTERM (exit code 75).");
  command->callback([arguments, &selected] {
    arguments->fleet.store.keys = arguments->scan.store_keys;
    selected.run = [arguments] { return ReportStatus(Run(*arguments)); };
  });
}

}  // namespace orbweave
