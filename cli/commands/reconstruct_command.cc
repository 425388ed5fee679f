// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/reconstruct_command.h"

#include <memory>
#include <string>

#include "cli/arguments/fail_on_argument.h"
#include "cli/arguments/fleet_argument.h"
#include "cli/arguments/image_arguments.h"
#include "cli/arguments/option_arguments.h"
#include "cli/jobs/run_local_job.h"
#include "cli/process/exit_code.h"
#include "stages/prepare_job.h"

namespace orbweave {
namespace {

struct ReconstructArguments {
  std::string database{};
  std::string gnss{};
  std::string clusters{};
  std::string output{};
  bool single = false;
  FleetArgument fleet{};
  FailOn fail_on{};
  OptionArguments options{};
};

absl::Status Reconstruct(const ReconstructArguments& arguments) {
  const StopSignals signals;
  ORBWEAVE_ASSIGN_OR_RETURN(PipelineOptions options, ReadOptions(arguments.options));
  if (arguments.single) options.partition.cluster_size = 0;
  const LocalJob job{
      .output = arguments.output,
      .fleet = arguments.fleet,
      .fail_on = arguments.fail_on,
      .prepare = [&](BlobDepot& coordinator, const StageContext& context) {
        return PrepareDatabaseJob(
            coordinator, arguments.database, arguments.gnss, arguments.clusters, options, context);
      }};
  return RunLocalJob(job, signals);
}

}  // namespace

void AddReconstructCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand(
      "reconstruct", "Reconstruct from the keypoints and matches of a COLMAP database");
  const auto arguments = std::make_shared<ReconstructArguments>();
  command
      ->add_option("--database", arguments->database, "COLMAP (3.8 to 4.x) or SphereSfM database")
      ->required();
  command
      ->add_option(
          "--output", arguments->output, "Folder of the results; run again with it to go on")
      ->required();
  command->add_option(
      "--gnss", arguments->gnss, "Positions, instead of the database's pose priors");
  AddHeightArgument(*command, arguments->options);
  AddClustersArgument(*command, arguments->clusters);
  command->add_flag("--single", arguments->single, "One cluster: do not divide")
      ->excludes("--clusters");
  AddFleetArguments(*command, arguments->fleet);
  AddFailOnArgument(*command, arguments->fail_on);
  AddOptionArguments(*command, arguments->options);
  command->footer(
      "Examples:\n"
      "  orbweave synth corridor --panoramas 500 --output corridor\n"
      "  orbweave reconstruct --database corridor/corridor.db --gnss corridor/gnss.csv --output "
      "model\n"
      "  orbweave reconstruct --database corridor/corridor.db --single --output undivided");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(Reconstruct(*arguments)); };
  });
}

}  // namespace orbweave
