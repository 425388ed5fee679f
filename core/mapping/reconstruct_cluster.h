// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/mapping/cluster_reconstruction.h"
#include "core/mapping/model/cluster_problem.h"
#include "core/mapping/model/mapping_options.h"

namespace orbweave {

/// Incremental spherical SfM: seed pair (or all images at once, options.start), next-best image by
/// visibility on the sphere, P3P, triangulation, track completion and merging, filtering, local and
/// global adjustment, retries, several submodels. No submodel is a value (every image in
/// `not_registered`). Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<ClusterReconstruction> ReconstructCluster(
    const ClusterProblem& problem, const MappingOptions& options, const StageContext& context);

}  // namespace orbweave
