// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/sum_of_ups.h"

namespace orbweave {
namespace {

constexpr double kMinUpright = 0.95;

}  // namespace

std::optional<Eigen::Vector3d> SumOfUps(std::span<const Eigen::Quaterniond> cams_from_world) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Quaterniond& cam_from_world : cams_from_world)
    sum -= cam_from_world.conjugate() * Eigen::Vector3d::UnitY();
  if (sum.norm() < kMinUpright * static_cast<double>(cams_from_world.size())) return std::nullopt;
  return sum;
}

}  // namespace orbweave
