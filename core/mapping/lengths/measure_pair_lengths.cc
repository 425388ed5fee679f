// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/measure_pair_lengths.h"

#include <optional>
#include <span>

#include "core/mapping/lengths/asked_rays.h"
#include "core/mapping/lengths/measure_gap_lengths.h"
#include "core/mapping/lengths/ray_depths.h"

namespace orbweave {
namespace {

/// What the rays of each pair's two images say, [2 i] of a and [2 i + 1] of b.
class RayCounts {
 public:
  RayCounts(const AskedRays& asked, double tolerance)
      : asked_(asked), tolerance_(tolerance), counts_(2 * asked.pairs.size()) {}

  /// `depths`: of one ray.
  void Add(std::span<const RayDepth> depths) {
    const LengthsOnRay ray(depths, asked_.log_lengths);
    for (const RayDepth& depth : depths) {
      const std::optional<double> told = ray.ToldByOthers(depth);
      if (!told) continue;
      counts_[SideOf(depth)].Add(*told, asked_.log_lengths[depth.pair], tolerance_);
    }
  }
  /// Of pair `i` of those asked.
  [[nodiscard]] LengthAgreement Of(size_t i) const {
    return AgreementOf({counts_[2 * i], counts_[2 * i + 1]});
  }

 private:
  [[nodiscard]] size_t SideOf(const RayDepth& depth) const {
    const CorrespondenceGraph& graph = asked_.state.Graph();
    const LinkedPair& pair = graph.pairs[asked_.pairs[depth.pair]];
    return 2 * size_t{depth.pair} + (graph.image_of_node[depth.node] == pair.b ? 1 : 0);
  }

  const AskedRays& asked_;
  double tolerance_;
  std::vector<RayCount> counts_;
};

}  // namespace

std::vector<PairLength> MeasurePairLengths(const AskedRays& asked, double tolerance) {
  RayCounts counts(asked, tolerance);
  ForEachRay(asked.depths, [&](std::span<const RayDepth> ray) { counts.Add(ray); });
  std::vector<PairLength> lengths;
  for (size_t i = 0; i < asked.pairs.size(); ++i) {
    const LinkedPair& pair = asked.state.Graph().pairs[asked.pairs[i]];
    lengths.push_back({asked.state.Problem().pairs[pair.index].pair, counts.Of(i)});
  }
  return lengths;
}

std::vector<LengthFault> FindLengthFaults(const MappingState& state,
                                          const MappingOptions& options) {
  const AskedRays asked(state, options);
  return FindLengthFaults(MeasurePairLengths(asked), MeasureGapLengths(asked));
}

double CountAgreeingRays(const MappingState& state, const MappingOptions& options) {
  double count = 0.0;
  for (const PairLength& pair : MeasurePairLengths({state, options}, kCloseTolerance))
    count += pair.agreement.agreeing;
  return count;
}

}  // namespace orbweave
