// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/submodel_level.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/estimators/mean_direction.h"
#include "core/geometry/rotation.h"
#include "core/geometry/sum_of_ups.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kFewestCameras = 10;
constexpr double kSlopes_rad = 3.0 * std::numbers::pi / 180.0;
constexpr double kLossScale_deg = 2.0;

}  // namespace

std::optional<SubmodelLevel> LevelOf(std::span<const Eigen::Quaterniond> cams_from_submodel) {
  const std::optional<Vector3d> sum = SumOfUps(cams_from_submodel);
  if (!sum || cams_from_submodel.size() < kFewestCameras) return std::nullopt;
  std::vector<Vector3d> ups;
  for (const Eigen::Quaterniond& cam_from_submodel : cams_from_submodel)
    ups.emplace_back(cam_from_submodel.conjugate() * -Vector3d::UnitY());
  const Vector3d up = RobustMeanDirection(ups, sum->normalized(), kLossScale_deg);
  std::vector<double> leans_rad;
  for (const Vector3d& of_camera : ups) leans_rad.push_back(AngleBetween(of_camera, up));
  return SubmodelLevel{.up = up,
                       .sigma_rad = std::hypot(kSlopes_rad, Quantile(std::move(leans_rad), 0.5))};
}

}  // namespace orbweave
