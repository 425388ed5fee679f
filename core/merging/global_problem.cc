// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/global_problem.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/merging/find_gravity.h"

namespace orbweave {
namespace {

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

void AddPositions(const ImageManifest& manifest,
                  const Georeference& georeference,
                  double bias_sigma_m,
                  GlobalProblem& problem) {
  const std::map<uint32_t, uint32_t> groups = GroupsOfDrives(problem, manifest);
  const bool has_biases = groups.size() > 1;
  if (has_biases) problem.bundle.bias_sigma_m.assign(groups.size(), bias_sigma_m);
  for (uint32_t pose = 0; pose < problem.image_of_pose.size(); ++pose) {
    const ImageRecord& image = manifest.At(problem.image_of_pose[pose]);
    if (!image.prior.position_in_enu) continue;
    const double horizontal_m =
        std::max(image.prior.horizontal_sigma_m, georeference.horizontal_scatter_m);
    const double vertical_m =
        std::max(image.prior.vertical_sigma_m, georeference.vertical_scatter_m);
    PositionPrior& prior = problem.bundle.position_priors.emplace_back();
    prior.pose = pose;
    prior.position_in_world = *image.prior.position_in_enu;
    prior.sigma_m = {horizontal_m, horizontal_m, vertical_m};
    if (has_biases) prior.bias_group = groups.at(image.drive);
  }
}

void AddGravity(const Reconstruction& reconstruction, GlobalProblem& problem) {
  if (!FindGravity(reconstruction)) return;
  const auto num_poses = static_cast<uint32_t>(problem.image_of_pose.size());
  const double sigma_rad = kGravitySigma_rad * std::sqrt(static_cast<double>(num_poses));
  for (uint32_t pose = 0; pose < num_poses; ++pose) {
    problem.bundle.direction_priors.push_back({.pose = pose, .sigma_rad = sigma_rad});
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

void AddGnss(const Reconstruction& reconstruction,
             const ImageManifest& manifest,
             const Georeference& georeference,
             double bias_sigma_m,
             GlobalProblem& problem) {
  AddPositions(manifest, georeference, bias_sigma_m, problem);
  AddGravity(reconstruction, problem);
}

}  // namespace orbweave
