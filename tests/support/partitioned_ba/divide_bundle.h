// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/partitioned_ba/bundle_subproblem.h"

namespace orbweave {

/// Divides a problem among the subproblems that own its panoramas (each pose has one owner <
/// num_subproblems). Tracks within one subproblem stay there; AssignTracks decides about the
/// others. A prior goes to the owner of its pose, a bias' own prior to the first subproblem that
/// uses it. Held poses and fixed points are constants of every subproblem that needs them. A
/// subproblem may be empty.
[[nodiscard]] std::vector<BundleSubproblem> DivideBundle(const BundleProblem& problem,
                                                         const std::vector<uint32_t>& owner_of_pose,
                                                         uint32_t num_subproblems);

/// Writes the poses and points of adjusted subproblems into the problem they were divided from.
void GatherBundle(const std::vector<BundleSubproblem>& subproblems, BundleProblem& problem);

}  // namespace orbweave
