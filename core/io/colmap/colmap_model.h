// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "core/geometry/equirectangular_camera.h"
#include "core/geometry/rigid3.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

constexpr uint64_t kNoColmapPoint = ~uint64_t{0};
constexpr int32_t kColmapEquirectangularId = 17;  ///< COLMAP >= 4.1: width, height
constexpr int32_t kColmapSphereId = 11;           ///< SphereSfM: f, cx, cy

struct ColmapPoint2d {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  uint64_t point3d_id = kNoColmapPoint;
};

struct ColmapImage {
  uint32_t image_id = 0;
  uint32_t camera_id = 0;
  std::string name{};
  Rigid3 cam_from_world{};
  std::vector<ColmapPoint2d> points2d{};
};

struct ColmapPoint3d {
  uint64_t point3d_id = 0;
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Rgb color{};
  double error_px = 0.0;                               ///< mean residual, pixels at the equator
  std::vector<std::pair<uint32_t, uint32_t>> track{};  ///< image id, index in its points2d
};

struct ColmapCamera {
  uint32_t camera_id = 0;
  EquirectangularCamera camera{};
};

/// A sparse model as COLMAP stores it; each list sorted by id.
struct ColmapModel {
  std::vector<ColmapCamera> cameras{};
  std::vector<ColmapImage> images{};
  std::vector<ColmapPoint3d> points{};
};

/// Reads a folder as ColmapModelWriter leaves it; SPHERE (id 11) is accepted too. NotFound: a file
/// is missing. InvalidArgument: another camera model, or bytes that are no model (names file and
/// place).
[[nodiscard]] absl::StatusOr<ColmapModel> ReadColmapModel(const std::string& folder);

}  // namespace orbweave
