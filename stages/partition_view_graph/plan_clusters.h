// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/artifacts/recipes.h"
#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// One recipe per cluster: its images with their drives and where these had them
/// (PositionsByMotion), the edges of `graph` among them, and the blobs these are in.
[[nodiscard]] std::vector<ClusterRecipe> PlanClusters(
    const Partition& partition,
    const ViewGraph& graph,
    const ImageManifest& manifest,
    const std::vector<Digest>& features,
    const std::map<ImagePair, Digest>& blob_of_pair);

}  // namespace orbweave
