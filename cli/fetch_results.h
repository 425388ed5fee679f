// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pipeline/coordinator_api.h"
#include "core/scene/features.h"
#include "core/scene/two_view_geometry.h"
#include "core/stages/build_job_report.h"

namespace orbweave {

/// The results of a finished job, fetched and decoded.
[[nodiscard]] absl::StatusOr<JobResults> FetchResults(CoordinatorApi& coordinator,
                                                      const JobSpec& job,
                                                      const std::vector<TaskOutcome>& outcomes);

/// The features of every image, in id order; `keep_descriptors` false leaves them empty.
[[nodiscard]] absl::StatusOr<std::vector<Features>> FetchFeatures(
    CoordinatorApi& coordinator,
    const JobSpec& job,
    const std::vector<TaskOutcome>& outcomes,
    bool keep_descriptors);

/// All verified pairs, sorted.
[[nodiscard]] absl::StatusOr<std::vector<TwoViewGeometry>> FetchVerifiedPairs(
    CoordinatorApi& coordinator, const std::vector<TaskOutcome>& outcomes);

/// The manifest alone: the job may still be running.
[[nodiscard]] absl::StatusOr<ImageManifest> FetchManifest(CoordinatorApi& coordinator,
                                                          const JobSpec& job,
                                                          const std::vector<TaskOutcome>& outcomes);

}  // namespace orbweave
