// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/asked_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/mapping/lengths/log_length_of_pair.h"

namespace orbweave {

AskedRays::AskedRays(const MappingState& of_state, const MappingOptions& options)
    : state(of_state), max_error_px(options.max_error_px) {
  const CorrespondenceGraph& graph = state.Graph();
  for (uint32_t p = 0; p < graph.pairs.size(); ++p) {
    const std::optional<double> log_length = LogLengthOfPair(state, graph.pairs[p]);
    if (!log_length) continue;
    pairs.push_back(p);
    log_lengths.push_back(*log_length);
  }
  const double min_angle_rad = options.min_angle_deg / 180.0 * std::numbers::pi;
  depths = MeasureRayDepths(state.Problem(), graph, pairs, min_angle_rad);
}

void RayCount::Add(double told_log_length, double log_length, double tolerance) {
  ++told;
  agreeing += std::abs(told_log_length - log_length) <= tolerance ? 1 : 0;
}

LengthAgreement AgreementOf(std::initializer_list<RayCount> sides) {
  LengthAgreement sum;
  for (const RayCount& count : sides) {
    if (count.told < kFewestRaysOfPair) continue;
    sum.told += static_cast<double>(count.told);
    sum.agreeing += static_cast<double>(count.agreeing);
  }
  const double weight = std::min(1.0, kMaxRaysOfPair / std::max(sum.told, 1.0));
  return {.told = weight * sum.told, .agreeing = weight * sum.agreeing};
}

}  // namespace orbweave
