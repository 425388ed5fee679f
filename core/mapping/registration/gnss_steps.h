// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/mapping/model/correspondence_graph.h"

namespace orbweave {

/// What GNSS says of the length of a pair's baseline: the logarithm of the horizontal distance d of
/// the two positions in metres, and its sigma, sqrt(s_a^2 + s_b^2) / d with the horizontal sigmas
/// of both. Infinite: nothing.
struct GnssStep {
  double log_length = 0.0;
  double sigma = std::numeric_limits<double>::infinity();
};

/// Between two images of the cluster.
[[nodiscard]] GnssStep StepBetween(const ClusterProblem& problem, ImageSlot a, ImageSlot b);

/// Of each of `pairs`, indices into graph.pairs.
[[nodiscard]] std::vector<GnssStep> GnssSteps(const ClusterProblem& problem,
                                              const CorrespondenceGraph& graph,
                                              std::span<const uint32_t> pairs);

/// The logarithm of the ratio of two steps as images see it, of b over a.
struct SeenRatio {
  uint32_t a = 0;  ///< positions among the steps
  uint32_t b = 0;
  double log_ratio = 0.0;
};

/// How many times their stated sigma the steps of GNSS are off, against ratios that images see
/// clearly: errors that neighbours share, as those of satellites and of a whole drive, cancel in
/// steps, which may be ten times as exact as positions; or a receiver may promise too much. The
/// median of |log_ratio - (l_b - l_a)| / sqrt(s_a^2 + s_b^2) over 0.6745, at least 0.05; 1 for
/// fewer than 20 ratios of steps that say something.
[[nodiscard]] double FactorOfSteps(std::span<const GnssStep> steps,
                                   std::span<const SeenRatio> ratios);

/// How many times their stated sigma errors are off, by the best quarter of them: `errors` in
/// sigmas, of which 0.3186 is the quarter of a normal one's. At least two where they are fewer than
/// eight, which do not tell what steps are worth.
[[nodiscard]] double FactorOfErrors(std::vector<double> errors);

}  // namespace orbweave
