// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace orbweave {

/// Of panoramas one after the other, how many were asked, and how many the next one is not next to.
struct OrderVotes {
  size_t asked = 0;
  size_t against = 0;

  void Add(const OrderVotes& other) {
    asked += other.asked;
    against += other.against;
  }
  /// A quarter are against at most: a carrier that turns back or goes round a block leaves most
  /// panoramas next to the next; names that are hashes, or numbers of a map, leave hardly any.
  [[nodiscard]] bool AreInOrder() const;
};

/// Whether places follow each other along a way. The next place is next to one when there are not
/// more nearer to it than a quarter of all, three at least and twenty at most. Where the camera
/// stood only the first counts. 500 places are asked, evenly spread, each for all others.
[[nodiscard]] OrderVotes VoteOnOrder(std::span<const Eigen::Vector3d> places);

/// Indices of places in an order in which they follow each other along a way that leads through all
/// of them: neighbours are joined, the nearest first, each to two others at most and to no circle
/// (the greedy path of the travelling salesman), then the ends of such pieces likewise. It begins
/// at that of its two ends which comes first. Places one after the other may still be far apart,
/// where the street forks. n log n.
[[nodiscard]] std::vector<uint32_t> OrderAlongWay(std::span<const Eigen::Vector3d> places);

/// That order where the given one is none (VoteOnOrder); nullopt where it may stay.
[[nodiscard]] std::optional<std::vector<uint32_t>> OrderIfInNone(
    std::span<const Eigen::Vector3d> places);

}  // namespace orbweave
