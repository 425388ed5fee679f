// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace orbweave {

/// Counts matches that speak for themselves. Matches of one thing - a car that follows, a window
/// taken for its neighbour - move together: as evidence for a pose they are worth no more than what
/// places a thing, three matches. A match is counted unless three that were counted before lie
/// within kReachRad of it in both panoramas, or one at the same spot of both. What is
/// counted depends on the order, on nothing else. Linear in the number of matches.
class PlacePairs {
 public:
  /// A car 25 m away, a shop front across a wide street.
  static constexpr double kReachRad = 8.0 * std::numbers::pi / 180.0;
  static constexpr size_t kMatchesOfAThing = 3;

  /// Whether the match, unit bearings in both panoramas, counts.
  bool Add(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

  struct Match {
    Eigen::Vector3d a;
    Eigen::Vector3d b;
  };
  [[nodiscard]] const std::vector<Match>& Counted() const { return counted_; }

 private:
  /// Cells as wide as the reach, by coordinates, and one more on every side.
  static constexpr int kSide = 18;
  static constexpr int32_t kNone = -1;
  static int CellOf(const Eigen::Vector3d& bearing);

  std::vector<int32_t> last_of_cell_ = std::vector<int32_t>(size_t{kSide} * kSide * kSide, kNone);
  std::vector<int32_t> before_{};  ///< of each counted one, the one before in its cell
  std::vector<Match> counted_{};
};

}  // namespace orbweave
