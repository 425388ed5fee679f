// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/dense/plane_errors.h"

namespace orbweave {

/// Texture, in variances of noise, of which a match of its own says less than a plane around.
inline constexpr float kWeakTexture = 6.0F;

/// Planes of the surroundings, and which of them a pixel without texture may lie on.
struct PlanarPrior {
  static constexpr uint8_t kNone = 255;

  int face_px = 0;
  std::vector<Eigen::Vector3f> planes{};  ///< q.x = 1 in the camera frame
  std::vector<PlaneErrors> errors{};      ///< of each
  std::vector<uint8_t> labels{};          ///< of the raster's pixels: index of a plane, or kNone
  std::vector<float> texture{};           ///< of its cells of 2 x 2 pixels (PlaneEvidence)
};

}  // namespace orbweave
