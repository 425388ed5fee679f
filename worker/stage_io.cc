// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "worker/stage_io.h"

#include "proto/codec/reconstruction_codec.h"

namespace orbweave {

absl::StatusOr<ExtractedBlobs> SplitExtracted(std::string_view collection) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> digests, DecodeCollection(collection));
  if (digests.size() % 2 != 0) {
    return absl::InvalidArgumentError(
        "extracted features: a Features blob without its PlaceSample");
  }
  ExtractedBlobs blobs;
  for (size_t i = 0; i < digests.size(); i += 2) {
    blobs.features.push_back(digests[i]);
    blobs.places.push_back(digests[i + 1]);
  }
  return blobs;
}

absl::StatusOr<std::vector<Submodel>> LoadRims(std::span<const Digest> rims, BlobAccess& blobs) {
  std::vector<Submodel> submodels;
  for (const Digest& digest : rims) {
    ORBWEAVE_ASSIGN_OR_RETURN(ClusterResult rim, FetchBlob(digest, blobs, DecodeClusterResult));
    uint32_t component = 0;
    for (Reconstruction& reconstruction : rim.reconstruction.components)
      submodels.push_back({rim.cluster, component++, std::move(reconstruction)});
  }
  return submodels;
}

}  // namespace orbweave
