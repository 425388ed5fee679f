// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/artifacts/check_bounds.h"

#include <algorithm>
#include <array>

#include "absl/strings/str_cat.h"

namespace orbweave {

absl::Status DoesNotFit(const std::string& what) {
  return absl::DataLossError("the results of this job do not fit together: " + what);
}

absl::Status CheckNumber(size_t number, size_t count, const std::string& what) {
  if (number < count) return absl::OkStatus();
  return DoesNotFit(absl::StrCat(what, " ", number, " of ", count));
}

absl::Status CheckImages(std::span<const ImageId> ids,
                         const ImageManifest& manifest,
                         const std::string& whose) {
  const size_t count = manifest.images.size();
  const auto foreign = std::ranges::find_if(ids, [count](ImageId id) { return id.value >= count; });
  if (foreign == ids.end()) return absl::OkStatus();
  return DoesNotFit(absl::StrCat(whose, " has image ", foreign->value, " of ", count));
}

absl::Status CheckPairs(std::span<const TwoViewGeometry> pairs, const ImageManifest& manifest) {
  for (const TwoViewGeometry& geometry : pairs) {
    ORBWEAVE_RETURN_IF_ERROR(
        CheckImages(std::array{geometry.pair.a, geometry.pair.b}, manifest, "a verified pair"));
  }
  return absl::OkStatus();
}

absl::Status CheckPairNumbers(std::span<const ImagePair> pairs, size_t num_images) {
  for (const ImagePair& pair : pairs) {
    for (const ImageId id : {pair.a, pair.b})
      ORBWEAVE_RETURN_IF_ERROR(CheckNumber(id.value, num_images, "a pair has image"));
  }
  return absl::OkStatus();
}

absl::Status CheckPartition(const Partition& partition, const ImageManifest& manifest) {
  for (size_t c = 0; c < partition.clusters.size(); ++c) {
    const std::string whose = absl::StrCat("cluster ", c);
    ORBWEAVE_RETURN_IF_ERROR(CheckImages(partition.clusters[c].images, manifest, whose));
    ORBWEAVE_RETURN_IF_ERROR(CheckImages(partition.clusters[c].interior, manifest, whose));
  }
  for (const Seam& seam : partition.seams) {
    if (seam.cluster_a >= seam.cluster_b)
      return DoesNotFit("a seam of a cluster with itself or an earlier one");
    ORBWEAVE_RETURN_IF_ERROR(
        CheckNumber(seam.cluster_b, partition.clusters.size(), "a seam names cluster"));
  }
  return absl::OkStatus();
}

absl::Status CheckRequests(std::span<const OverlapRequest> requests, const Partition& partition) {
  const size_t count = partition.clusters.size();
  for (const OverlapRequest& request : requests) {
    for (const uint32_t cluster : {request.cluster_a, request.cluster_b})
      ORBWEAVE_RETURN_IF_ERROR(CheckNumber(cluster, count, "a review asks for overlap of cluster"));
  }
  return absl::OkStatus();
}

absl::Status CheckAlignedClusters(const Alignment& alignment, const Partition& partition) {
  for (const SubmodelExtent& submodel : alignment.submodels) {
    ORBWEAVE_RETURN_IF_ERROR(CheckNumber(
        submodel.cluster, partition.clusters.size(), "the alignment has a submodel of cluster"));
  }
  return absl::OkStatus();
}

absl::Status CheckSubmodels(std::span<const Submodel> submodels,
                            const Alignment& alignment,
                            const Partition& partition) {
  if (alignment.submodels.size() != submodels.size() || alignment.world.size() != submodels.size())
    return DoesNotFit("the alignment is of other submodels");
  for (size_t m = 0; m < submodels.size(); ++m) {
    const uint32_t cluster = submodels[m].cluster;
    ORBWEAVE_RETURN_IF_ERROR(
        CheckNumber(cluster, partition.clusters.size(), "a boundary is of cluster"));
    if (alignment.submodels[m].cluster != cluster)
      return DoesNotFit("the alignment is of submodels of other clusters");
    for (const auto& [id, image] : submodels[m].reconstruction.images) {
      if (!std::ranges::binary_search(partition.clusters[cluster].images, id))
        return DoesNotFit(absl::StrCat("cluster ", cluster, " has no image ", id.value));
    }
  }
  return absl::OkStatus();
}

}  // namespace orbweave
