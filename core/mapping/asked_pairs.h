// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mapping/mapping_options.h"
#include "core/mapping/mapping_state.h"
#include "core/mapping/pair_length.h"
#include "core/mapping/ray_depths.h"

namespace orbweave {

/// Pairs whose lengths in a model are asked for (LogLengthOfPair), as indices into the graph's, and
/// those lengths.
struct AskedPairs {
  std::vector<uint32_t> pairs{};
  std::vector<double> log_lengths{};

  explicit AskedPairs(const MappingState& state);

  /// MeasureRayDepths of them.
  [[nodiscard]] std::vector<RayDepth> DepthsOf(const MappingState& state,
                                               const MappingOptions& options) const;
};

/// Rays of one image that tell how long one pair is.
struct RayCount {
  size_t told = 0;
  size_t agreeing = 0;

  void Add(double told_log_length, double log_length);
};

/// Of both images of a pair: eight rays of an image at least, 200 of the pair at most.
[[nodiscard]] LengthAgreement SumOfSides(const RayCount& of_a, const RayCount& of_b);

}  // namespace orbweave
