// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/upright.h"

#include <vector>

#include "core/geometry/rotation.h"
#include "core/geometry/sum_of_ups.h"

namespace orbweave {
std::optional<Eigen::Quaterniond> UprightFromWorld(
    std::span<const Eigen::Quaterniond> cams_from_world) {
  const std::optional<Eigen::Vector3d> up = SumOfUps(cams_from_world);
  if (!up) return std::nullopt;
  return RotationBetween(*up, Eigen::Vector3d::UnitZ());
}

std::optional<Eigen::Quaterniond> UprightFromWorld(const MappingState& state,
                                                   std::span<const ImageSlot> images) {
  std::vector<Eigen::Quaterniond> cams_from_world;
  for (const ImageSlot image : images)
    cams_from_world.push_back(state.CamFromWorld(image).rotation);
  return UprightFromWorld(cams_from_world);
}

}  // namespace orbweave
