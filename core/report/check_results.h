// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/artifacts/check_bounds.h"
#include "core/artifacts/dense_records.h"
#include "core/base/status.h"
#include "core/report/job_results.h"

namespace orbweave {

/// The same as check_bounds.h for results of a job, before outputs are written. DataLoss says what
/// does not fit.

/// Images lie where their ids say.
[[nodiscard]] absl::Status CheckManifest(const ImageManifest& manifest);

/// They are of images of the manifest.
[[nodiscard]] absl::Status CheckCarriers(const std::vector<Carrier>& carriers,
                                         const ImageManifest& manifest);

/// Each is one of the partition's, and speaks of images of the manifest.
[[nodiscard]] absl::Status CheckClusters(const std::vector<ClusterSummary>& clusters,
                                         const Partition& partition,
                                         const ImageManifest& manifest);

/// It has as many submodels as the clusters together, and seams between these.
[[nodiscard]] absl::Status CheckAlignment(const Alignment& alignment,
                                          const std::vector<ClusterSummary>& clusters);

/// Panoramas of the manifest, with or without depth.
[[nodiscard]] absl::Status CheckDensePlan(const DensePlan& plan, const ImageManifest& manifest);

/// Its points are at places that can be computed with.
[[nodiscard]] absl::Status CheckTile(const DenseTile& tile);

/// Images of the manifest, at places that can be computed with.
[[nodiscard]] absl::Status CheckModel(const std::map<ImageId, RegisteredImage>& images,
                                      const ImageManifest& manifest);

}  // namespace orbweave
