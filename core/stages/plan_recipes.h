// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"
#include "core/stages/recipes.h"

namespace orbweave {

/// One recipe per image, in id order.
[[nodiscard]] std::vector<ExtractRecipe> PlanExtraction(const ImageManifest& manifest);

/// Cuts sorted pairs into runs of `pairs_per_task`; neighbours in order share images, so a run
/// opens few Features. `features[id]` is the blob of each image.
[[nodiscard]] std::vector<MatchRecipe> PlanMatching(std::vector<MatchRecipe::Pair> pairs,
                                                    const std::vector<Digest>& features,
                                                    size_t pairs_per_task);

/// The images of a cluster that other clusters have too, sorted.
[[nodiscard]] std::vector<ImageId> SharedImages(const Partition& partition, uint32_t cluster);

/// One recipe per cluster: its images with their GNSS positions, the edges of `graph` among them,
/// and the blobs these are in.
[[nodiscard]] std::vector<ClusterRecipe> PlanClusters(
    const Partition& partition,
    const ViewGraph& graph,
    const ImageManifest& manifest,
    const std::vector<Digest>& features,
    const std::map<ImagePair, Digest>& blob_of_pair);

/// Per cluster what FitSeams reads of it: its rim, then those of the later clusters that it has a
/// seam with, ascending. `rims`: per cluster.
[[nodiscard]] std::vector<std::vector<Digest>> PlanSeams(const Partition& partition,
                                                         const std::vector<Digest>& rims);

}  // namespace orbweave
