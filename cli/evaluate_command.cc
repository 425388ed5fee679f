// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/evaluate_command.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/exit_code.h"
#include "cli/surface_text.h"
#include "core/estimators/compare_poses.h"
#include "core/estimators/compare_with_claims.h"
#include "core/io/camera_sigmas.h"
#include "core/io/colmap_model.h"
#include "core/io/file.h"
#include "core/io/reference_poses.h"

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

/// What the sigmas of cameras.csv, which is beside the models of a job, are worth.
absl::Status PrintClaims(const std::string& folder,
                         const ColmapModel& model,
                         const std::map<std::string, Rigid3>& truth) {
  const std::string path = folder + "/cameras.csv";
  if (!std::filesystem::exists(path)) return absl::OkStatus();
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto sigma_of_name, ParseCameraSigmas(text, path));
  std::vector<Rigid3> estimated;
  std::vector<Rigid3> reference;
  std::vector<Eigen::Vector3d> sigmas;
  for (const ColmapImage& image : model.images) {
    const auto known = truth.find(image.name);
    const auto sigma = sigma_of_name.find(image.name);
    if (known == truth.end() || sigma == sigma_of_name.end()) continue;
    estimated.push_back(image.cam_from_world);
    reference.push_back(known->second);
    sigmas.push_back(sigma->second);
  }
  const std::optional<ClaimErrors> errors = CompareWithClaims(estimated, sigmas, reference);
  if (!errors) return absl::OkStatus();
  const Eigen::Vector3d& ratio = errors->squared_over_variance;
  std::printf("  claimed     %.2f, %.2f, %.2f squared error over variance along x, y, z (%s)\n",
              ratio.x(),
              ratio.y(),
              ratio.z(),
              errors->is_relative ? "relative to the camera whose pose is held" : "absolute");
  return absl::OkStatus();
}

absl::Status Evaluate(const EvaluateArguments& arguments) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, ReadFile(arguments.truth));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto truth, ParseReferencePoses(text, arguments.truth));
  const bool is_model = std::filesystem::exists(arguments.output + "/images.bin");
  ORBWEAVE_ASSIGN_OR_RETURN(
      const ColmapModel model,
      ReadColmapModel(is_model ? arguments.output : arguments.output + "/sparse/0"));
  std::vector<Rigid3> estimated;
  std::vector<Rigid3> reference;
  for (const ColmapImage& image : model.images) {
    const auto found = truth.find(image.name);
    if (found == truth.end()) continue;
    estimated.push_back(image.cam_from_world);
    reference.push_back(found->second);
  }
  const auto errors = ComparePoses(estimated, reference);
  if (!errors) {
    return absl::InvalidArgumentError("fewer than three cameras of the model have a pose in " +
                                      arguments.truth + ", or they are in one place");
  }
  Print(*errors, estimated.size(), truth.size());
  if (!arguments.surface.empty()) {
    std::vector<Eigen::Vector3d> centres;
    for (const Rigid3& camera : reference) centres.push_back(camera.Centre());
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string found,
                              SurfaceText(arguments.output + "/dense",
                                          arguments.surface,
                                          errors->reference_from_model,
                                          std::move(centres)));
    std::fputs(found.c_str(), stdout);
  }
  return is_model ? absl::OkStatus() : PrintClaims(arguments.output, model, truth);
}

}  // namespace

void AddEvaluateCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("evaluate", "Compare a model with known poses");
  const auto arguments = std::make_shared<EvaluateArguments>();
  command
      ->add_option(
          "OUTPUT", arguments->output, "Output folder of a job, or a folder with a COLMAP model")
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
