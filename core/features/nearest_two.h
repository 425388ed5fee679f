// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace orbweave {

/// Squared distance of "nothing there": larger than any of two descriptors.
constexpr int32_t kNoDistance = 1 << 28;

/// The two smallest squared distances from one descriptor to those of another set.
struct NearestTwo {
  int32_t best = kNoDistance;
  int32_t second = kNoDistance;  ///< equal to `best` when two are equally near
  uint32_t index = 0;            ///< of the nearest, the smallest of equals

  friend bool operator==(const NearestTwo&, const NearestTwo&) = default;
};

/// The two nearest of two sets, which may have some in common.
[[nodiscard]] inline NearestTwo MergeNearest(const NearestTwo& x, const NearestTwo& y) {
  if (x.best == y.best && x.index == y.index)
    return {x.best, std::min(x.second, y.second), x.index};
  const bool is_x = x.best != y.best ? x.best < y.best : x.index < y.index;
  const NearestTwo& nearer = is_x ? x : y;
  return {nearer.best, std::min(nearer.second, is_x ? y.best : x.best), nearer.index};
}

struct NearestTwoBothWays {
  std::vector<NearestTwo> of_a{};  ///< for every descriptor of a its nearest in b
  std::vector<NearestTwo> of_b{};  ///< and the other way round
};

}  // namespace orbweave
