// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mapping/model/correspondence_graph.h"

namespace orbweave {

/// How far a ray reaches as one match of it has it, in units of the pair's baseline: by the law of
/// sines sin(B) / sin(X), with the triangle's angles at the other camera and at the point.
struct RayDepth {
  Node node = 0;
  uint32_t pair = 0;  ///< position among the given pairs
  double log_depth = 0.0;
};

/// Those of both rays of all matches of `pairs` (indices into graph.pairs, none a pure rotation),
/// sorted by node, then by pair, as matches follow each other. Rays that meet under less than
/// `min_angle_rad`, and rays towards the baseline (sine below 0.05), say nothing of depth and are
/// left out.
[[nodiscard]] std::vector<RayDepth> MeasureRayDepths(const ClusterProblem& problem,
                                                     const CorrespondenceGraph& graph,
                                                     std::span<const uint32_t> pairs,
                                                     double min_angle_rad);

/// Calls visit(depths of one ray) for each ray; `depths` as MeasureRayDepths sorts them.
template <typename Visit>
void ForEachRay(std::span<const RayDepth> depths, const Visit& visit) {
  for (size_t from = 0, to = 0; from < depths.size(); from = to) {
    while (to < depths.size() && depths[to].node == depths[from].node) ++to;
    visit(depths.subspan(from, to - from));
  }
}

/// How far a ray reaches as several pairs have it: the lower median of the logarithms, which are
/// put in another order; nullopt of none.
[[nodiscard]] std::optional<double> MedianReach(std::span<double> log_reaches);

/// What the pairs that share one ray, whose lengths are known, say of each other's.
class LengthsOnRay {
 public:
  /// `ray`: the depths of one ray; `log_lengths`: per pair.
  LengthsOnRay(std::span<const RayDepth> ray, std::span<const double> log_lengths);

  /// How long the baseline of asked.pair is by the other pairs of the ray: log s_p = log s_q +
  /// log d_q - log d_p, the median over all q. nullopt where none shares it.
  [[nodiscard]] std::optional<double> ToldByOthers(const RayDepth& asked) const;

 private:
  struct Reach {
    double log_distance = 0.0;  ///< log s_q + log d_q
    uint32_t pair = 0;
  };
  std::vector<Reach> reaches_{};  ///< ascending
};

}  // namespace orbweave
