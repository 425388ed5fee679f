// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/bundle/block_matrix.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/gauge.h"

namespace orbweave {

/// "No block": of a held pose, or of a bias that nobody estimates.
inline constexpr uint32_t kHeld = std::numeric_limits<uint32_t>::max();

/// An observation as the inner loops want it.
struct PackedObservation {
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();
  double weight = 1.0;  ///< 1 / sigma^2
  uint32_t pose = 0;
  uint32_t local = kHeld;  ///< of the pose's block among its chunk's
};

/// A point with its observations [first, end), ascending by pose.
struct PackedPoint {
  uint32_t point = 0;
  uint32_t first = 0;
  uint32_t end = 0;
  bool is_fixed = false;
};

/// Consecutive points whose sums are formed together, in a dense upper triangle over the blocks of
/// the poses that see them: block pair (i <= j) lies at j (j + 1) / 2 + i.
struct PointChunk {
  /// Where a touched block pair of the triangle belongs in the sparse matrix.
  struct Target {
    uint32_t pair = 0;
    uint32_t value = 0;
  };
  uint32_t first_point = 0;
  uint32_t end_point = 0;
  std::vector<uint32_t> blocks{};  ///< ascending
  std::vector<Target> targets{};

  [[nodiscard]] size_t NumPairs() const { return blocks.size() * (blocks.size() + 1) / 2; }
};

inline size_t PairIndex(uint32_t i, uint32_t j) { return static_cast<size_t>(j) * (j + 1) / 2 + i; }

/// The fixed structure of one solve. Blocks: free poses in pose order, then estimated biases, then
/// retained points, which are variables of the matrix instead of being eliminated.
/// Chunks depend on the problem alone, so that sums merged in chunk order have the same bits
/// for any number of threads.
struct BundleLayout {
  std::vector<uint32_t> pose_block{};  ///< per pose
  std::vector<uint32_t> bias_block{};  ///< per bias group
  uint32_t first_retained_point = 0;   ///< block of the first retained point
  uint32_t num_blocks = 0;
  std::vector<PackedObservation> observations{};
  std::vector<PackedPoint> points{};  ///< those with observations, by smallest free pose
  std::vector<PackedPoint> retained_points{};
  std::vector<PointChunk> chunks{};
  SymmetricBlockMatrix matrix{};  ///< its pattern, no values
  BundleResidual residual = BundleResidual::kAngle;
};

/// `retained_points`: ascending, none of them fixed.
[[nodiscard]] BundleLayout MakeBundleLayout(const BundleProblem& problem,
                                            const Gauge& gauge,
                                            const std::vector<uint32_t>& retained_points = {});

}  // namespace orbweave
