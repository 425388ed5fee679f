// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"
#include "core/mapping/registration/registration_log.h"

namespace orbweave {

/// Joins submodels of one cluster, each image in at most one, that bridges hold together
/// (FindBridge), and single images that are in none. Those with most matches between them come
/// first; points of both are kept, those of the pairs between are added, all is adjusted, and what
/// is joined grows on (GrowSubmodel). A join stays when nine tenths of its images and a quarter of
/// the matches of the pairs between, min_inliers at least, have a common point; else both sides
/// are as they were. Leaves submodels by their first image; single images that nothing joins are
/// none of them. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<std::vector<MappingState>> JoinByBridges(
    std::vector<MappingState> submodels,
    const ClusterProblem& problem,
    const CorrespondenceGraph& graph,
    const MappingOptions& options,
    RegistrationLog& log,
    const StageContext& context);

}  // namespace orbweave
