// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/shared_images.h"

#include <set>

namespace orbweave {

std::vector<std::vector<uint32_t>> ClustersOfImages(const std::vector<Cluster>& clusters,
                                                    size_t num_images) {
  std::vector<std::vector<uint32_t>> clusters_of_image(num_images);
  for (uint32_t c = 0; c < clusters.size(); ++c) {
    for (const ImageId id : clusters[c].images) clusters_of_image[id.value].push_back(c);
  }
  return clusters_of_image;
}

std::vector<ImageId> SharedImages(const Partition& partition, uint32_t cluster) {
  std::set<ImageId> shared;
  for (const Seam& seam : partition.seams) {
    if (seam.cluster_a == cluster || seam.cluster_b == cluster)
      shared.insert(seam.shared.begin(), seam.shared.end());
  }
  return {shared.begin(), shared.end()};
}

}  // namespace orbweave
