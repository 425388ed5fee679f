// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/upright.h"

#include <vector>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

/// Length of the mean of the unit vectors that cameras call up: cameras on a car lean the same way
/// in its own axes and turn with it, which leaves the cosine of the lean, 0.97 for 15 degrees.
constexpr double kMinUpright = 0.95;

}  // namespace

std::optional<Eigen::Quaterniond> UprightFromWorld(
    std::span<const Eigen::Quaterniond> cams_from_world) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Quaterniond& cam_from_world : cams_from_world)
    sum -= cam_from_world.conjugate() * Eigen::Vector3d::UnitY();
  if (sum.norm() < kMinUpright * static_cast<double>(cams_from_world.size())) return std::nullopt;
  return RotationBetween(sum, Eigen::Vector3d::UnitZ());
}

std::optional<Eigen::Quaterniond> UprightFromWorld(const MappingState& state,
                                                   std::span<const ImageSlot> images) {
  std::vector<Eigen::Quaterniond> cams_from_world;
  for (const ImageSlot image : images)
    cams_from_world.push_back(state.CamFromWorld(image).rotation);
  return UprightFromWorld(cams_from_world);
}

}  // namespace orbweave
