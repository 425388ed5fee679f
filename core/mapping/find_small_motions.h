// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/mapping/model/cluster_problem.h"

namespace orbweave {

/// For a cluster that shows no model, as the motion between most of its images stays within the
/// errors that matches are allowed (EstimateTwoView): the cluster with general pairs in
/// place of those whose matches tell the direction of a motion all the same. With the rotation R of
/// the pair that is the t that minimises the sum of ((R a x b) t)^2, then refined with R. It is
/// told when the rays a and b are at least three times as far apart as from the epipolar planes, in
/// the median, and nine of ten of those that are so by themselves, 30 at least, move towards t, as
/// what is in front of both panoramas does, while errors move to both sides alike. Those high up
/// are not asked: clouds go their own way. nullopt where no pure rotation tells.
[[nodiscard]] std::optional<ClusterProblem> FindSmallMotions(const ClusterProblem& problem);

}  // namespace orbweave
