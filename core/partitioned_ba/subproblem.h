// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/geometry/equirectangular_camera.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// An image of a subproblem of the global adjustment. Its pose is in the subproblem's scene.
struct SubproblemImage {
  ImageId id{};
  EquirectangularCamera camera{};
  uint32_t owner = 0;         ///< the cluster whose subproblem answers for the image
  bool is_separator = false;  ///< terms of two subproblems or more depend on its pose
  bool is_held = false;       ///< the gauge's anchor
};

/// This subproblem's part of a track that no subproblem can eliminate alone.
struct SplitTrack {
  uint32_t id = 0;  ///< in the world
  Track part{};
};

/// What GNSS says of an image's centre, east-north-up metres.
struct SubproblemPrior {
  ImageId image{};
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Ones();
  std::optional<uint32_t> bias_group{};
};

/// What attitudes say of an image's rotation (DirectionPrior), in the world and in the camera.
struct SubproblemDirection {
  ImageId image{};
  Eigen::Vector3d direction_in_world = -Eigen::Vector3d::UnitZ();
  Eigen::Vector3d direction_in_cam = Eigen::Vector3d::UnitY();
  double sigma_rad = 0.1;
};

/// The bias of a drive, and the sigma of its own prior; infinity where another subproblem counts
/// it.
struct SubproblemBias {
  uint32_t group = 0;
  bool is_separator = false;
  double sigma_m = std::numeric_limits<double>::infinity();
  Eigen::Vector3d value_m = Eigen::Vector3d::Zero();
};

/// One cluster's share of a world, complete in itself: its terms of the global adjustment and all
/// variables that they need. Every observation, prior and image is owned by exactly one subproblem
/// of the world; images that this subproblem's tracks see and others own are there too.
struct Subproblem {
  uint32_t world = 0;
  uint32_t cluster = 0;
  Reconstruction scene{};                 ///< poses, and the tracks that this subproblem eliminates
  std::vector<SubproblemImage> images{};  ///< those of the scene, in the same order
  std::vector<SplitTrack> split{};        ///< ascending by id
  std::vector<SubproblemPrior> priors{};  ///< of owned images, ascending
  std::vector<SubproblemBias> biases{};   ///< of those priors, ascending
  std::vector<SubproblemDirection> directions{};  ///< of owned images
  /// The image whose distance from the held one the gauge keeps; where neither priors do.
  std::optional<ImageId> farthest{};

  [[nodiscard]] bool Owns(const SubproblemImage& image) const { return image.owner == cluster; }
};

}  // namespace orbweave
