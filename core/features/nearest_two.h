// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

struct NearestTwoBothWays {
  std::vector<NearestTwo> of_a{};  ///< for every descriptor of a its nearest in b
  std::vector<NearestTwo> of_b{};  ///< and the other way round
};

}  // namespace orbweave
