// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/evaluate_command.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/process/exit_code.h"
#include "cli/results/surface_text.h"
#include "core/estimators/compare_poses.h"
#include "core/estimators/compare_with_claims.h"
#include "core/io/colmap/colmap_model.h"
#include "core/io/file.h"
#include "core/io/gnss/reference_poses.h"
#include "core/io/images/camera_sigmas.h"

namespace orbweave {
namespace {

struct EvaluateArguments {
  std::string output{};
  std::string truth{};
  std::string surface{};
};

void Print(const PoseErrors& errors, size_t compared, size_t known) {
  std::printf("  compared    %zu of %zu cameras with known pose\n", compared, known);
  std::printf("  position    %.4f m RMSE, %.4f m max (after a similarity)\n",
              errors.position_rmse_m,
              errors.position_max_m);
  std::printf("              %.4f m RMSE as georeferenced (no alignment)\n",
              errors.unaligned_rmse_m);
  std::printf("              %.4f m RMSE of the step to the next camera\n",
              errors.neighbour_rmse_m);
  std::printf("              %.4f m RMSE within every 30 cameras in a row\n", errors.window_rmse_m);
  std::printf("  rotation    %.4f deg median, %.4f deg max\n",
              errors.rotation_median_deg,
              errors.rotation_max_deg);
}

/// The cameras of a model whose true pose is known.
struct KnownCameras {
  std::vector<std::string> names{};
  std::vector<Rigid3> estimated{};
  std::vector<Rigid3> reference{};
};

absl::StatusOr<KnownCameras> ReadKnownCameras(const std::string& folder,
                                              const std::map<std::string, Rigid3>& truth) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ColmapModel model, ReadColmapModel(folder));
  KnownCameras known;
  for (const ColmapImage& image : model.images) {
    const auto found = truth.find(image.name);
    if (found == truth.end()) continue;
    known.names.push_back(image.name);
    known.estimated.push_back(image.cam_from_world);
    known.reference.push_back(found->second);
  }
  return known;
}

/// What the sigmas of cameras.csv are worth.
void PrintClaims(const std::map<std::string, Eigen::Vector3d>& sigma_of_name,
                 const KnownCameras& known) {
  std::vector<Rigid3> estimated;
  std::vector<Rigid3> reference;
  std::vector<Eigen::Vector3d> sigmas;
  for (size_t i = 0; i < known.names.size(); ++i) {
    const auto sigma = sigma_of_name.find(known.names[i]);
    if (sigma == sigma_of_name.end()) continue;
    estimated.push_back(known.estimated[i]);
    reference.push_back(known.reference[i]);
    sigmas.push_back(sigma->second);
  }
  const std::optional<ClaimErrors> errors = CompareWithClaims(estimated, sigmas, reference);
  if (!errors) return;
  const Eigen::Vector3d& ratio = errors->squared_over_variance;
  std::printf("  claimed     %.2f, %.2f, %.2f squared error over variance along x, y, z (%s)\n",
              ratio.x(),
              ratio.y(),
              ratio.z(),
              errors->is_relative ? "relative to the camera whose pose is held" : "absolute");
  std::printf("              %zu of %zu cameras off by more than three sigmas and 5 cm\n",
              errors->misplaced,
              errors->cameras);
}

/// The models that a folder holds: itself, or those of a job's output, the largest first.
std::vector<std::string> ModelFolders(const std::string& output) {
  if (std::filesystem::exists(output + "/images.bin")) return {output};
  std::vector<std::string> folders = {output + "/sparse/0"};
  while (true) {
    const std::string next = output + "/sparse/" + std::to_string(folders.size());
    if (!std::filesystem::exists(next)) return folders;
    folders.push_back(next);
  }
}

/// Sigmas of a job's cameras; none where a model comes alone.
absl::StatusOr<std::map<std::string, Eigen::Vector3d>> ReadSigmas(const std::string& output) {
  const std::string path = output + "/cameras.csv";
  if (!std::filesystem::exists(path)) return std::map<std::string, Eigen::Vector3d>{};
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  return ParseCameraSigmas(text, path);
}

absl::Status PrintSurface(const EvaluateArguments& arguments,
                          const KnownCameras& known,
                          const PoseErrors& errors) {
  std::vector<Eigen::Vector3d> centres;
  for (const Rigid3& camera : known.reference) centres.push_back(camera.Centre());
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string found,
                            SurfaceText(arguments.output + "/dense",
                                        arguments.surface,
                                        errors.reference_from_model,
                                        std::move(centres)));
  std::fputs(found.c_str(), stdout);
  return absl::OkStatus();
}

absl::Status Evaluate(const EvaluateArguments& arguments) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, ReadFile(arguments.truth));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto truth, ParseReferencePoses(text, arguments.truth));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto sigma_of_name, ReadSigmas(arguments.output));
  const std::vector<std::string> folders = ModelFolders(arguments.output);
  for (const std::string& folder : folders) {
    const bool is_largest = folder == folders.front();
    ORBWEAVE_ASSIGN_OR_RETURN(const KnownCameras known, ReadKnownCameras(folder, truth));
    const auto errors = ComparePoses(known.estimated, known.reference);
    if (folders.size() > 1) std::printf("%s\n", folder.c_str());
    if (errors) {
      Print(*errors, known.names.size(), truth.size());
    } else if (is_largest) {
      return absl::InvalidArgumentError("fewer than three cameras of the model have a pose in " +
                                        arguments.truth + ", or they are in one place");
    } else {
      std::printf("  compared    none: fewer than three cameras with known pose\n");
    }
    if (is_largest && !arguments.surface.empty()) {
      ORBWEAVE_RETURN_IF_ERROR(PrintSurface(arguments, known, *errors));
    }
    PrintClaims(sigma_of_name, known);
  }
  return absl::OkStatus();
}

}  // namespace

void AddEvaluateCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("evaluate", "Compare a model with known poses");
  const auto arguments = std::make_shared<EvaluateArguments>();
  command
      ->add_option("OUTPUT",
                   arguments->output,
                   "Output folder of a job (each of its models is compared), or a folder with a "
                   "COLMAP model")
      ->required();
  command
      ->add_option(
          "--truth", arguments->truth, "CSV: name,x,y,z,qw,qx,qy,qz (cam_from_world, metres)")
      ->required();
  command->add_option("--surface",
                      arguments->surface,
                      "PLY with points of the true surface, in the frame of --truth: judges the "
                      "dense cloud in OUTPUT/dense");
  command->footer(
      "Examples:\n"
      "  orbweave evaluate model --truth street/truth.csv\n"
      "  orbweave evaluate model --truth street/truth.csv --surface street/surface.ply");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(Evaluate(*arguments)); };
  });
}

}  // namespace orbweave
