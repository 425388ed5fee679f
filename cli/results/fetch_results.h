// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/pipeline/blob_access.h"
#include "core/pipeline/job_api.h"
#include "core/report/job_results.h"
#include "core/scene/features.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// Is shown the points of a job's models while they pass by; nobody holds all of them.
class ModelListener {
 public:
  virtual ~ModelListener() = default;
  /// The next model. Both arguments stay where they are until EndModel returns.
  virtual void BeginModel(const std::map<ImageId, RegisteredImage>& images,
                          const ImageManifest& manifest) = 0;
  virtual void TakePoint(const Track& track) = 0;
  [[nodiscard]] virtual absl::Status EndModel() = 0;
};

/// The results of a finished job, fetched and decoded; models go by `listener`, which may be null.
[[nodiscard]] absl::StatusOr<JobResults> FetchResults(BlobAccess& coordinator,
                                                      const JobSpec& job,
                                                      const std::vector<TaskOutcome>& outcomes,
                                                      ModelListener* listener);

/// What goes along with the cameras, where the job looked for it. NotFound: it has not come so far.
[[nodiscard]] absl::StatusOr<std::vector<Carrier>> FetchCarriers(
    BlobAccess& coordinator, const JobSpec& job, const std::vector<TaskOutcome>& outcomes);

/// The names of every image's features, in id order.
[[nodiscard]] absl::StatusOr<std::vector<Digest>> FetchFeatureNames(
    BlobAccess& coordinator, const JobSpec& job, const std::vector<TaskOutcome>& outcomes);

[[nodiscard]] absl::StatusOr<Features> FetchFeatures(BlobAccess& coordinator, const Digest& name);

/// All verified pairs, sorted.
[[nodiscard]] absl::StatusOr<std::vector<TwoViewGeometry>> FetchVerifiedPairs(
    BlobAccess& coordinator, const JobSpec& job, const std::vector<TaskOutcome>& outcomes);

/// The manifest alone: the job may still be running.
[[nodiscard]] absl::StatusOr<ImageManifest> FetchManifest(BlobAccess& coordinator,
                                                          const JobSpec& job,
                                                          const std::vector<TaskOutcome>& outcomes);

}  // namespace orbweave
