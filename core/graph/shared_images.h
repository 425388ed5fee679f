// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

/// Per image, of `num_images`: the clusters that have it, ascending.
[[nodiscard]] std::vector<std::vector<uint32_t>> ClustersOfImages(
    const std::vector<Cluster>& clusters, size_t num_images);

/// The images of a cluster that other clusters have too, sorted.
[[nodiscard]] std::vector<ImageId> SharedImages(const Partition& partition, uint32_t cluster);

}  // namespace orbweave
