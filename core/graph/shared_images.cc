// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/shared_images.h"

#include <set>

namespace orbweave {

std::vector<ImageId> SharedImages(const Partition& partition, uint32_t cluster) {
  std::set<ImageId> shared;
  for (const Seam& seam : partition.seams) {
    if (seam.cluster_a == cluster || seam.cluster_b == cluster)
      shared.insert(seam.shared.begin(), seam.shared.end());
  }
  return {shared.begin(), shared.end()};
}

}  // namespace orbweave
