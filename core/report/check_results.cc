// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/check_results.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

constexpr double kFarthest = 1e9;  // a model's centres are from its origin, in metres or units

}  // namespace

absl::Status CheckManifest(const ImageManifest& manifest) {
  for (size_t i = 0; i < manifest.images.size(); ++i) {
    if (manifest.images[i].id.value != i)
      return DoesNotFit(absl::StrCat("image ", i, " is called ", manifest.images[i].id.value));
  }
  return absl::OkStatus();
}

absl::Status CheckCarriers(const std::vector<Carrier>& carriers, const ImageManifest& manifest) {
  for (const Carrier& carrier : carriers)
    ORBWEAVE_RETURN_IF_ERROR(CheckImages(carrier.images, manifest, "a carrier"));
  return absl::OkStatus();
}

absl::Status CheckClusters(const std::vector<ClusterSummary>& clusters,
                           const Partition& partition,
                           const ImageManifest& manifest) {
  for (const ClusterSummary& cluster : clusters) {
    ORBWEAVE_RETURN_IF_ERROR(
        CheckNumber(cluster.cluster, partition.clusters.size(), "a reconstruction is of cluster"));
    const std::string whose = absl::StrCat("cluster ", cluster.cluster);
    for (const NotRegistered& missing : cluster.not_registered)
      ORBWEAVE_RETURN_IF_ERROR(CheckImages({&missing.image, 1}, manifest, whose));
    for (const CrossingPair& pair : cluster.parted_pairs)
      ORBWEAVE_RETURN_IF_ERROR(CheckImages({&pair.pair.b, 1}, manifest, whose));
    for (const PairLength& length : cluster.pair_lengths)
      ORBWEAVE_RETURN_IF_ERROR(CheckImages({&length.pair.b, 1}, manifest, whose));
    for (const GapLength& length : cluster.gap_lengths) {
      for (const ImageId& image : {length.between.a, length.between.b})
        ORBWEAVE_RETURN_IF_ERROR(CheckImages({&image, 1}, manifest, whose));
    }
    for (const auto* pairs : {&cluster.contradicted_pairs, &cluster.explained_pairs}) {
      for (const ImagePair& pair : *pairs) {
        ORBWEAVE_RETURN_IF_ERROR(CheckImages({&pair.a, 1}, manifest, whose));
        ORBWEAVE_RETURN_IF_ERROR(CheckImages({&pair.b, 1}, manifest, whose));
      }
    }
  }
  return absl::OkStatus();
}

absl::Status CheckAlignment(const Alignment& alignment,
                            const std::vector<ClusterSummary>& clusters) {
  const size_t submodels = std::accumulate(
      clusters.begin(), clusters.end(), size_t{0}, [](size_t sum, const ClusterSummary& cluster) {
        return sum + cluster.submodels.size();
      });
  if (alignment.world.size() != submodels) {
    return DoesNotFit(
        absl::StrCat("alignment of ", alignment.world.size(), " of ", submodels, " submodels"));
  }
  for (const SeamReport& seam : alignment.seams) {
    ORBWEAVE_RETURN_IF_ERROR(
        CheckNumber(seam.submodel_a, submodels, "a seam of the alignment names submodel"));
    ORBWEAVE_RETURN_IF_ERROR(
        CheckNumber(seam.submodel_b, submodels, "a seam of the alignment names submodel"));
  }
  return absl::OkStatus();
}

absl::Status CheckDensePlan(const DensePlan& plan, const ImageManifest& manifest) {
  for (const DensePanorama& panorama : plan.panoramas) {
    ORBWEAVE_RETURN_IF_ERROR(
        CheckImages({&panorama.file.image, 1}, manifest, "the plan of depths"));
    if (!(panorama.unit_m > 1.0 / kFarthest && panorama.unit_m < kFarthest))
      return DoesNotFit("the plan of depths has a unit that nobody can compute with");
  }
  for (const DenseOmission& omission : plan.omitted)
    ORBWEAVE_RETURN_IF_ERROR(CheckImages({&omission.image, 1}, manifest, "the plan of depths"));
  return absl::OkStatus();
}

absl::Status CheckTile(const DenseTile& tile) {
  const bool fits = std::ranges::all_of(tile.points, [](const SurfacePoint& point) {
    return point.position_in_world.norm() < kFarthest;
  });
  if (fits) return absl::OkStatus();
  return DoesNotFit(
      absl::StrCat("tile ", tile.cell.x, " ", tile.cell.y, " has a point that lies nowhere"));
}

absl::Status CheckModel(const std::map<ImageId, RegisteredImage>& images,
                        const ImageManifest& manifest) {
  for (const auto& [id, image] : images) {
    ORBWEAVE_RETURN_IF_ERROR(CheckImages({&id, 1}, manifest, "a model"));
    if (!(image.cam_from_world.Centre().norm() < kFarthest))
      return DoesNotFit(absl::StrCat("image ", id.value, " of a model stands nowhere"));
  }
  return absl::OkStatus();
}

}  // namespace orbweave
