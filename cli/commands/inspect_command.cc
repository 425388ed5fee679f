// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/inspect_command.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli/inspect/inspect_image.h"
#include "cli/inspect/inspect_pair.h"
#include "cli/inspect/inspected_job.h"
#include "cli/process/exit_code.h"
#include "core/base/clock.h"
#include "core/io/file.h"
#include "core/io/images/find_image.h"

namespace orbweave {
namespace {

struct InspectArguments {
  std::string output{};
  std::vector<std::string> pair{};
  std::string image{};
  std::string picture{};
  FeatureColors colors = FeatureColors::kTrackLength;
};

absl::StatusOr<Inspection> Look(InspectedJob& job, const InspectArguments& arguments) {
  if (arguments.pair.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const ImageId image, FindImage(job.manifest(), arguments.image));
    return InspectImageOfJob(job, image, arguments.colors);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageId first, FindImage(job.manifest(), arguments.pair[0]));
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageId second, FindImage(job.manifest(), arguments.pair[1]));
  if (first == second) {
    return absl::InvalidArgumentError("both names mean " + job.manifest().At(first).name +
                                      "; a pair is of two images");
  }
  return InspectPairOfJob(job, first, second);
}

absl::Status WritePicture(const Inspection& inspection, const InspectArguments& arguments) {
  std::filesystem::path path(arguments.picture);
  if (arguments.picture.empty()) {
    path = std::filesystem::path(arguments.output) / "inspect" / inspection.file_name;
    ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(path.parent_path().string()));
  }
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(path.string(), inspection.png));
  std::printf("picture    %s\n", path.string().c_str());
  return absl::OkStatus();
}

absl::Status Inspect(const InspectArguments& arguments) {
  if (arguments.pair.empty() == arguments.image.empty())
    return absl::InvalidArgumentError("inspect: give either --pair A B or --image A");
  const SteadyClock clock;
  ORBWEAVE_ASSIGN_OR_RETURN(const auto job, InspectedJob::Open(arguments.output, clock));
  ORBWEAVE_ASSIGN_OR_RETURN(const Inspection inspection, Look(*job, arguments));
  std::fputs(inspection.text.c_str(), stdout);
  return WritePicture(inspection, arguments);
}

}  // namespace

void AddInspectCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand(
      "inspect", "Look at one pair or one image of a job: a picture, and the numbers behind it");
  const auto arguments = std::make_shared<InspectArguments>();
  command->add_option("OUTPUT", arguments->output, "Output folder of a job")->required();
  command
      ->add_option("--pair",
                   arguments->pair,
                   "Two images: their matches, what geometry these have, epipolar curves, or why "
                   "there is none; matched here when the job did not")
      ->expected(2)
      ->type_name("A B");
  command
      ->add_option("--image",
                   arguments->image,
                   "One image: its features and tracks, its partners, why it was left out")
      ->type_name("A");
  command
      ->add_option(
          "--output", arguments->picture, "PNG file to write (default: OUTPUT/inspect/NAMES.png)")
      ->type_name("FILE.png");
  command->add_option("--color", arguments->colors, "What colours the features of --image show")
      ->transform(CLI::CheckedTransformer(std::map<std::string, FeatureColors>{
          {"length", FeatureColors::kTrackLength}, {"residual", FeatureColors::kResidual}}))
      ->type_name("length|residual")
      ->default_str("length");
  command->footer(
      "An image may be named by its number, or by what only its name ends in.\n"
      "Examples:\n"
      "  orbweave inspect model --pair 00012.jpg 00013.jpg\n"
      "  orbweave inspect model --pair 12 13 --output why.png\n"
      "  orbweave inspect model --image 00012.jpg --color residual");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(Inspect(*arguments)); };
  });
}

}  // namespace orbweave
