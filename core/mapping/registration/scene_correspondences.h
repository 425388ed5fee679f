// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Which feature of an image may show which scene point, from matches with registered images:
/// parallel arrays, every (node, point) once. A node may be listed with several points.
struct SceneCorrespondences {
  std::vector<Node> nodes{};
  std::vector<PointIndex> points{};
  std::vector<Eigen::Vector3d> bearings{};   ///< of the nodes, in the camera frame
  std::vector<Eigen::Vector3d> positions{};  ///< of the points, in the world

  [[nodiscard]] size_t size() const { return nodes.size(); }
};

[[nodiscard]] SceneCorrespondences FindSceneCorrespondences(const MappingState& state,
                                                            ImageSlot image);

/// Agreement of a pose with correspondences: who is within max_error_rad, and how many different
/// features and different points agree, whichever is less.
struct PoseSupport {
  std::vector<uint8_t> is_inlier{};
  uint32_t count = 0;
};

[[nodiscard]] PoseSupport SupportOf(const Rigid3& cam_from_world,
                                    const SceneCorrespondences& correspondences,
                                    double max_error_rad);

}  // namespace orbweave
