// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace orbweave {

/// How well the scene points that an image sees are spread over its sphere: the multi-resolution
/// score of Schonberger and Frahm (Structure-from-Motion Revisited, CVPR 2016, section 4.2) with
/// their image cells replaced by cells of equal solid angle. Level l = 0, 1, 2 divides the sphere
/// into K_l x K_l cells, K_l = 2, 4, 8; every cell that holds a visible feature adds K_l^2.
class VisibilityPyramid {
 public:
  static constexpr int kFinest = 8;  ///< cells per side on the finest level

  /// The finest cell of a unit bearing, 0 ... 63: 8 sectors of longitude by 8 bands of equal
  /// height.
  [[nodiscard]] static uint8_t CellOf(const Eigen::Vector3d& bearing);

  /// One more, or one fewer, visible feature in the finest cell `cell`.
  void Add(uint8_t cell);
  void Remove(uint8_t cell);

  [[nodiscard]] uint32_t Count() const { return count_; }
  [[nodiscard]] uint32_t Score() const { return score_; }

 private:
  static constexpr int kLevels = 3;
  std::array<std::array<uint32_t, kFinest * kFinest>, kLevels> counts_{};
  uint32_t count_ = 0;
  uint32_t score_ = 0;
};

}  // namespace orbweave
