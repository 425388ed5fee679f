// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/global_problem.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/geometry/rotation.h"
#include "core/merging/georeference/estimate_gravity.h"
#include "core/merging/georeference/gnss_track.h"

namespace orbweave {
namespace {

// Of the bias of a drive that is in another datum than others.
constexpr double kUnknownBias_m = 100.0;
// Of the height of the frame's origin, where nobody knows it.
constexpr double kHeightOfOrigin_m = 100.0;

// Drives of the images that have a position, numbered from 0 in order of their number.
std::map<uint32_t, uint32_t> GroupsOfDrives(const GlobalProblem& problem,
                                            const ImageManifest& manifest) {
  std::map<uint32_t, uint32_t> groups;
  for (const ImageId id : problem.image_of_pose) {
    if (manifest.At(id).prior.position_in_enu) groups.emplace(manifest.At(id).drive, 0);
  }
  uint32_t next = 0;
  for (auto& [drive, group] : groups) group = next++;
  return groups;
}

// The positions of all images with what their drives have wrong taken off.
std::map<ImageId, Eigen::Vector3d> CorrectedPositions(const Reconstruction& reconstruction,
                                                      const ImageManifest& manifest,
                                                      const Georeference& georeference,
                                                      const Sim3& enu_from_world) {
  std::map<ImageId, Eigen::Vector3d> positions;
  for (const GnssDrive& drive : GnssDrivesOf(reconstruction, manifest)) {
    const auto errors =
        std::ranges::find(georeference.drive_errors, drive.drive, &DriveErrors::drive);
    for (const DrivenFix& fix : drive.fixes) {
      positions[fix.image] = fix.position_in_enu;
      if (errors != georeference.drive_errors.end())
        positions[fix.image] -= ErrorAt(*errors, fix, enu_from_world);
    }
  }
  return positions;
}

bool IsInAnotherDatum(const Georeference& georeference, uint32_t drive) {
  const auto errors = std::ranges::find(georeference.drive_errors, drive, &DriveErrors::drive);
  return errors != georeference.drive_errors.end() && !errors->offset_m.isZero();
}

// Where nobody knows a height, one in the middle of the model holds it at that of the origin: more
// of them would lay hills flat.
void HoldUnknownHeights(std::vector<PositionPrior>& priors) {
  if (priors.empty() || std::ranges::any_of(priors, &PositionPrior::is_height_known)) return;
  priors[priors.size() / 2].sigma_m.z() = kHeightOfOrigin_m;
}

void AddPositions(const Reconstruction& reconstruction,
                  const ImageManifest& manifest,
                  const Georeference& georeference,
                  double bias_sigma_m,
                  GlobalProblem& problem) {
  const std::map<uint32_t, uint32_t> groups = GroupsOfDrives(problem, manifest);
  const bool has_biases = groups.size() > 1;
  if (has_biases) problem.bundle.bias_sigma_m.assign(groups.size(), bias_sigma_m);
  for (const auto& [drive, group] : groups) {
    if (has_biases && IsInAnotherDatum(georeference, drive))
      problem.bundle.bias_sigma_m[group] = std::max(bias_sigma_m, kUnknownBias_m);
  }
  const auto positions = CorrectedPositions(reconstruction, manifest, georeference, {});
  for (uint32_t pose = 0; pose < problem.image_of_pose.size(); ++pose) {
    const ImageRecord& image = manifest.At(problem.image_of_pose[pose]);
    if (!image.prior.position_in_enu) continue;
    const double horizontal_m =
        std::max(image.prior.horizontal_sigma_m, georeference.horizontal_scatter_m);
    const double vertical_m =
        std::max(image.prior.vertical_sigma_m, georeference.vertical_scatter_m);
    PositionPrior& prior = problem.bundle.position_priors.emplace_back();
    prior.pose = pose;
    prior.position_in_world = positions.at(image.id);
    prior.sigma_m = {horizontal_m, horizontal_m, vertical_m};
    prior.is_height_known = IsHeightKnown(image.prior.vertical_sigma_m);
    if (has_biases) prior.bias_group = groups.at(image.drive);
  }
  HoldUnknownHeights(problem.bundle.position_priors);
}

// The world stands as `gravity` says, give or take its sigma: every image sees down where it is now
// seen by its own attitude.
void AddGravity(const Reconstruction& reconstruction,
                const ImageManifest& manifest,
                double weight,
                GlobalProblem& problem) {
  const std::optional<Gravity> gravity = EstimateGravity(reconstruction, manifest);
  if (!gravity) return;
  const auto num_poses = static_cast<uint32_t>(problem.image_of_pose.size());
  const double away_rad = AngleBetween(gravity->down_in_world, -Eigen::Vector3d::UnitZ());
  const double sigma_rad =
      gravity->SigmaAt(away_rad) * std::sqrt(static_cast<double>(num_poses) / weight);
  for (uint32_t pose = 0; pose < num_poses; ++pose) {
    const Eigen::Quaterniond& cam_from_world = problem.bundle.cams_from_world[pose].rotation;
    problem.bundle.direction_priors.push_back(
        {.pose = pose,
         .direction_in_cam = (cam_from_world * gravity->down_in_world).normalized(),
         .sigma_rad = sigma_rad});
  }
}

}  // namespace

GlobalProblem MakeGlobalProblem(const Reconstruction& reconstruction) {
  GlobalProblem problem;
  for (const auto& [id, image] : reconstruction.images) {
    if (image.loose) continue;
    problem.image_of_pose.push_back(id);
    problem.bundle.cams_from_world.push_back(image.cam_from_world);
  }
  return problem;
}

ImageManifest WithoutDriveErrors(const Reconstruction& reconstruction,
                                 ImageManifest manifest,
                                 const Georeference& georeference) {
  if (!georeference.enu_from_world || georeference.drive_errors.empty()) return manifest;
  const auto positions =
      CorrectedPositions(reconstruction, manifest, georeference, *georeference.enu_from_world);
  for (const auto& [id, position] : positions)
    manifest.images[id.value].prior.position_in_enu = position;
  return manifest;
}

void AddGnss(const Reconstruction& reconstruction,
             const ImageManifest& manifest,
             const Georeference& georeference,
             double bias_sigma_m,
             double gravity_weight,
             GlobalProblem& problem) {
  AddPositions(reconstruction, manifest, georeference, bias_sigma_m, problem);
  AddGravity(reconstruction, manifest, gravity_weight, problem);
}

}  // namespace orbweave
