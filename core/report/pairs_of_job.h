// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>

#include "core/report/job_results.h"

namespace orbweave {

/// Verified pairs that bear the finished models out, and those that contradict them.
struct PairsOfJob {
  std::set<ImagePair> explained{};
  std::set<ImagePair> contradicted{};
};

/// What clusters' reconstructions say of their pairs (JudgePairs); a pair of two clusters that one
/// of them contradicts is contradicted. Pairs of images that no cluster, or no submodel of one, had
/// together (CrossingPair) are held against the finished model that has both: how its poses turn
/// and lead from the one to the other. By more than 20 degrees off in either, a pair is
/// contradicted, by less than 10 in both explained, between them neither. Direction is not asked
/// where the images are nearer than half a step (StepsApart).
[[nodiscard]] PairsOfJob JudgePairsOfJob(const JobResults& results);

}  // namespace orbweave
