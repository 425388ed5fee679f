// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/measure_pair_lengths.h"

#include <optional>
#include <span>

#include "core/mapping/asked_pairs.h"
#include "core/mapping/measure_gap_lengths.h"
#include "core/mapping/ray_depths.h"

namespace orbweave {
namespace {

/// What the rays of each pair's two images say, [2 i] of a and [2 i + 1] of b.
class RayCounts {
 public:
  RayCounts(const MappingState& state, const AskedPairs& asked)
      : state_(state), asked_(asked), counts_(2 * asked.pairs.size()) {}

  /// `depths`: of one ray.
  void Add(std::span<const RayDepth> depths) {
    for (const RayDepth& depth : depths) {
      const std::optional<double> told = ToldLogLength(depths, depth, asked_.log_lengths);
      if (!told) continue;
      counts_[SideOf(depth)].Add(*told, asked_.log_lengths[depth.pair]);
    }
  }
  /// Of pair `i` of those asked.
  [[nodiscard]] LengthAgreement Of(size_t i) const {
    return SumOfSides(counts_[2 * i], counts_[2 * i + 1]);
  }

 private:
  [[nodiscard]] size_t SideOf(const RayDepth& depth) const {
    const LinkedPair& pair = state_.Graph().pairs[asked_.pairs[depth.pair]];
    return 2 * size_t{depth.pair} + (state_.Graph().image_of_node[depth.node] == pair.b ? 1 : 0);
  }

  const MappingState& state_;
  const AskedPairs& asked_;
  std::vector<RayCount> counts_;
};

}  // namespace

std::vector<PairLength> MeasurePairLengths(const MappingState& state,
                                           const MappingOptions& options) {
  const AskedPairs asked(state);
  const std::vector<RayDepth> depths = asked.DepthsOf(state, options);
  RayCounts counts(state, asked);
  ForEachRay(depths, [&](std::span<const RayDepth> ray) { counts.Add(ray); });
  std::vector<PairLength> lengths;
  for (size_t i = 0; i < asked.pairs.size(); ++i) {
    const LinkedPair& pair = state.Graph().pairs[asked.pairs[i]];
    lengths.push_back({state.Problem().pairs[pair.index].pair, counts.Of(i)});
  }
  return lengths;
}

std::vector<LengthFault> FindLengthFaults(const MappingState& state,
                                          const MappingOptions& options) {
  return FindLengthFaults(MeasurePairLengths(state, options), MeasureGapLengths(state, options));
}

double CountAgreeingRays(const MappingState& state, const MappingOptions& options) {
  double count = 0.0;
  for (const PairLength& pair : MeasurePairLengths(state, options))
    count += pair.agreement.agreeing;
  return count;
}

}  // namespace orbweave
