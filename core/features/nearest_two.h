// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
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

/// Ways to compute the same integers.
enum class DistanceKernel { kPortable, kAvx2, kAvx512Vnni };

/// Those that this processor can run, slowest first.
[[nodiscard]] std::vector<DistanceKernel> AvailableDistanceKernels();

/// All squared distances between two sets of kDescriptorSize-byte descriptors, computed once and
/// used in both directions: |a|^2 + |b|^2 - 2 a.b in 32-bit integers, so that every kernel gives
/// the same result on every machine. Either set may be empty.
[[nodiscard]] NearestTwoBothWays FindNearestTwo(std::span<const uint8_t> a,
                                                std::span<const uint8_t> b,
                                                DistanceKernel kernel);

/// The same with the fastest kernel of this processor.
[[nodiscard]] NearestTwoBothWays FindNearestTwo(std::span<const uint8_t> a,
                                                std::span<const uint8_t> b);

}  // namespace orbweave
