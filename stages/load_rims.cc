// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/load_rims.h"

#include <utility>

#include "core/artifacts/check_bounds.h"
#include "stages/codecs.h"
#include "stages/stage_task.h"

namespace orbweave {

absl::StatusOr<std::vector<Submodel>> LoadBoundaries(std::span<const Digest> boundaries,
                                                     BlobAccess& blobs) {
  std::vector<Submodel> submodels;
  uint32_t cluster = 0;
  bool is_first = true;
  for (const Digest& digest : boundaries) {
    ORBWEAVE_ASSIGN_OR_RETURN(ClusterResult boundary, FetchBlob<ClusterResult>(digest, blobs));
    if (!is_first && boundary.cluster <= cluster)
      return BlameBlob(DoesNotFit("boundaries of clusters are not in order"), digest);
    is_first = false;
    cluster = boundary.cluster;
    uint32_t submodel = 0;
    for (Reconstruction& reconstruction : boundary.reconstruction.submodels)
      submodels.push_back({boundary.cluster, submodel++, std::move(reconstruction)});
  }
  return submodels;
}

}  // namespace orbweave
