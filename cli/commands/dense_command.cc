// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/dense_command.h"

#include <memory>
#include <string>

#include "cli/arguments/fleet_argument.h"
#include "cli/arguments/option_arguments.h"
#include "cli/jobs/dense_job.h"
#include "cli/process/exit_code.h"
#include "core/io/images/scan_image_folder.h"

namespace orbweave {
namespace {

struct DenseArguments {
  std::string model{};  ///< output folder of a finished job
  std::string colmap{};
  ScanRequest images{};
  std::string output{};
  FleetArgument fleet{};
  OptionArguments options{};
};

absl::Status Dense(const DenseArguments& arguments) {
  const StopSignals signals;
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, ReadOptions(arguments.options));
  if (!arguments.colmap.empty()) {
    if (arguments.images.image_folder.empty() || arguments.output.empty())
      return absl::InvalidArgumentError("--colmap needs --images and --output");
    return RunDenseJobOnColmap(
        arguments.colmap, arguments.images, arguments.output, arguments.fleet, options, signals);
  }
  if (arguments.model.empty())
    return absl::InvalidArgumentError("name the output folder of a finished job, or --colmap");
  return RunDenseJob(arguments.model, arguments.fleet, options, signals);
}

}  // namespace

void AddDenseCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand(
      "dense", "Compute one coloured cloud of surfaces from a finished model, on this machine");
  const auto arguments = std::make_shared<DenseArguments>();
  command->add_option("OUTPUT",
                      arguments->model,
                      "Output folder of a finished job on images; the cloud goes to OUTPUT/dense");
  command->add_option("--colmap",
                      arguments->colmap,
                      "Instead: a COLMAP model with EQUIRECTANGULAR or SPHERE cameras; its points "
                      "are used, but not needed");
  command->add_option("--images", arguments->images.image_folder, "With --colmap: the panoramas");
  command->add_option("--masks", arguments->images.masks, "With --colmap: their masks");
  command->add_option("--output", arguments->output, "With --colmap: where the cloud goes");
  AddFleetArguments(*command, arguments->fleet);
  AddOptionArguments(*command, arguments->options);
  command->footer(
      "Examples:\n"
      "  orbweave dense model\n"
      "  orbweave dense model --workers 4 --set sources.max_sources=6\n"
      "  orbweave dense --colmap sparse/0 --images images --output cloud --set sources.far_m=30\n"
      "Ctrl-C stops cleanly; the same command goes on where it was.");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(Dense(*arguments)); };
  });
}

}  // namespace orbweave
