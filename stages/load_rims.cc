// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/load_rims.h"

#include <utility>

#include "stages/codecs.h"
#include "stages/stage_task.h"

namespace orbweave {

absl::StatusOr<std::vector<Submodel>> LoadBoundaries(std::span<const Digest> boundaries,
                                                     BlobAccess& blobs) {
  std::vector<Submodel> submodels;
  for (const Digest& digest : boundaries) {
    ORBWEAVE_ASSIGN_OR_RETURN(ClusterResult boundary, FetchBlob<ClusterResult>(digest, blobs));
    uint32_t submodel = 0;
    for (Reconstruction& reconstruction : boundary.reconstruction.submodels)
      submodels.push_back({boundary.cluster, submodel++, std::move(reconstruction)});
  }
  return submodels;
}

}  // namespace orbweave
