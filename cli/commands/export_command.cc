// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/export_command.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "cli/process/exit_code.h"
#include "cli/results/export_cubemap.h"
#include "cli/results/fetch_results.h"
#include "cli/results/finished_job.h"
#include "core/base/clock.h"
#include "core/io/colmap/write_colmap_database.h"

namespace orbweave {
namespace {

struct ExportArguments {
  std::string output{};
  std::string database{};
  DatabaseCameraModel camera = DatabaseCameraModel::kEquirectangular;
  std::string cubemap{};
  int face_px = 0;
  std::string formats = "colmap,nerfstudio,openmvs";
};

absl::Status ExportDatabase(ClientApi& coordinator, const ExportArguments& arguments) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus job, LastFinishedJob(coordinator, arguments.output));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskOutcome> outcomes,
                            coordinator.GetOutcomes(job.id));
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            FetchManifest(coordinator, job.spec, outcomes));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> names,
                            FetchFeatureNames(coordinator, job.spec, outcomes));
  std::vector<Features> features;
  for (const Digest& name : names) {
    ORBWEAVE_ASSIGN_OR_RETURN(features.emplace_back(), FetchFeatures(coordinator, name));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const auto pairs, FetchVerifiedPairs(coordinator, job.spec, outcomes));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteColmapDatabase(arguments.database, manifest, features, pairs, arguments.camera));
  std::printf("%zu images and %zu verified pairs written to %s\n",
              features.size(),
              pairs.size(),
              arguments.database.c_str());
  return absl::OkStatus();
}

absl::Status Export(const ExportArguments& arguments) {
  const SteadyClock clock;
  CubeExportOptions cube;
  cube.size_px = arguments.face_px;
  cube.num_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  ORBWEAVE_RETURN_IF_ERROR(SetCubeFormats(arguments.formats, cube));
  if (arguments.database.empty() && arguments.cubemap.empty()) {
    return absl::InvalidArgumentError("nothing to export: give --database, --cubemap or both");
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, OpenFinished(arguments.output, clock));
  if (!arguments.database.empty()) {
    ORBWEAVE_RETURN_IF_ERROR(ExportDatabase(*coordinator, arguments));
  }
  if (arguments.cubemap.empty()) return absl::OkStatus();
  return ExportCubemap(*coordinator, arguments.output, arguments.cubemap, cube);
}

}  // namespace

void AddExportCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand(
      "export", "Write a job's features and matches, or its model as pinhole images, for others");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("OUTPUT", arguments->output, "Output folder of a finished job")->required();
  command->add_option(
      "--database", arguments->database, "COLMAP database to write; replaced when it exists");
  command
      ->add_option("--camera", arguments->camera, "equirectangular (COLMAP) or sphere (SphereSfM)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, DatabaseCameraModel>{
          {"equirectangular", DatabaseCameraModel::kEquirectangular},
          {"sphere", DatabaseCameraModel::kSphere}}))
      ->type_name("equirectangular|sphere")
      ->default_str("equirectangular");
  command->add_option("--cubemap",
                      arguments->cubemap,
                      "Folder for six pinhole images of each panorama, their masks and model");
  command->add_option("--size", arguments->face_px, "Pixels of their sides (default: width / pi)")
      ->check(CLI::Range(16, 16384))
      ->needs("--cubemap");
  command
      ->add_option(
          "--format", arguments->formats, "Programs to write their model for, with commas between")
      ->capture_default_str()
      ->needs("--cubemap");
  command->footer(
      "Examples:\n"
      "  orbweave export model --database model.db\n"
      "  orbweave export model --database model.db --camera sphere\n"
      "  orbweave export model --cubemap cube --format colmap,openmvs");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(Export(*arguments)); };
  });
}

}  // namespace orbweave
