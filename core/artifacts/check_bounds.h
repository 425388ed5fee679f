// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "core/merging/alignment/alignment.h"
#include "core/merging/alignment/submodel.h"
#include "core/scene/image_manifest.h"
#include "core/scene/two_view_geometry.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// What workers leave comes from many of them, and each names what others left by number. These
/// look whether such numbers name anything, before anybody counts on it. DataLoss says what does
/// not. What an artifact says of itself is its decoder's to check.

/// DataLoss: artifacts of one job contradict each other.
[[nodiscard]] absl::Status DoesNotFit(const std::string& what);

/// `what` is the number of one of `count` things.
[[nodiscard]] absl::Status CheckNumber(size_t number, size_t count, const std::string& what);

/// `whose`: who names them.
[[nodiscard]] absl::Status CheckImages(std::span<const ImageId> ids,
                                       const ImageManifest& manifest,
                                       const std::string& whose);

/// Pairs are of images of the manifest.
[[nodiscard]] absl::Status CheckPairs(std::span<const TwoViewGeometry> pairs,
                                      const ImageManifest& manifest);

/// The same of pairs alone: numbers of `num_images` images.
[[nodiscard]] absl::Status CheckPairNumbers(std::span<const ImagePair> pairs, size_t num_images);

/// Clusters have images of the manifest alone, seams two different clusters.
[[nodiscard]] absl::Status CheckPartition(const Partition& partition,
                                          const ImageManifest& manifest);

/// Requests are for two of the clusters.
[[nodiscard]] absl::Status CheckRequests(std::span<const OverlapRequest> requests,
                                         const Partition& partition);

/// Submodels are what became of the clusters.
[[nodiscard]] absl::Status CheckAlignedClusters(const Alignment& alignment,
                                                const Partition& partition);

/// The same; they have images of their clusters alone, and are those of the alignment.
[[nodiscard]] absl::Status CheckSubmodels(std::span<const Submodel> submodels,
                                          const Alignment& alignment,
                                          const Partition& partition);

}  // namespace orbweave
