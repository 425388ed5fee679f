// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/choose_local_frame.h"

#include <vector>

#include "core/base/quantile.h"
#include "core/merging/georeference/estimate_gravity.h"
#include "core/merging/georeference/find_gravity.h"
#include "core/merging/georeference/turn_to_headings.h"

namespace orbweave {
namespace {

std::vector<Eigen::Vector3d> Centres(const Reconstruction& reconstruction) {
  std::vector<Eigen::Vector3d> centres;
  for (const auto& [id, image] : reconstruction.images) {
    if (!image.loose) centres.push_back(image.cam_from_world.Centre());
  }
  return centres;
}

double MedianStep(const std::vector<Eigen::Vector3d>& centres) {
  std::vector<double> steps;
  for (size_t i = 1; i < centres.size(); ++i) steps.push_back((centres[i] - centres[i - 1]).norm());
  return Quantile(std::move(steps), 0.5);
}

Eigen::Vector3d MedianGnss(const Reconstruction& reconstruction, const ImageManifest& manifest) {
  std::vector<double> axes[3];
  for (const auto& [id, image] : reconstruction.images) {
    const std::optional<Eigen::Vector3d>& position = manifest.At(id).prior.position_in_enu;
    if (!position) continue;
    for (int k = 0; k < 3; ++k) axes[k].push_back((*position)[k]);
  }
  return {Quantile(axes[0], 0.5), Quantile(axes[1], 0.5), Quantile(axes[2], 0.5)};
}

}  // namespace

Sim3 ChooseLocalFrame(const Reconstruction& reconstruction, const ImageManifest& manifest) {
  Sim3 local_from_world;
  const std::vector<Eigen::Vector3d> centres = Centres(reconstruction);
  if (centres.empty()) return local_from_world;
  const double step = MedianStep(centres);
  if (step > 0.0) local_from_world.scale = 1.0 / step;
  if (const auto down = EstimateGravity(reconstruction, manifest)) {
    const Eigen::Quaterniond upright = UprightFromDown(down->down_in_world);
    const double turn = TurnToHeadings(reconstruction, upright, manifest).value_or(0.0);
    local_from_world.rotation = Eigen::AngleAxisd(-turn, Eigen::Vector3d::UnitZ()) * upright;
  }
  local_from_world.translation =
      MedianGnss(reconstruction, manifest) - local_from_world * centres.front();
  return local_from_world;
}

}  // namespace orbweave
