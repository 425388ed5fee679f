// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/base/status.h"
#include "core/scene/view_graph.h"

namespace orbweave {

struct PartitionOptions {
  int cluster_size = 100;
  int min_clusters = 1;
  int min_cluster_size = 16;
  int overlap = 12;
  int reviews = 2;
  int max_overlap = 48;
  double max_condition = 1000.0;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("cluster_size",
          self.cluster_size,
          "panoramas per cluster before overlap; 0: one cluster",
          Range{0, 1000000});
    visit("min_clusters",
          self.min_clusters,
          "divide each connected part of the view graph into at least this many clusters where the "
          "images suffice",
          Range{1, 100000});
    visit("min_cluster_size",
          self.min_cluster_size,
          "panoramas per cluster before overlap that min_clusters leaves at least",
          Range{2, 100000});
    visit("overlap",
          self.overlap,
          "images shared at every place where clusters meet, at least",
          Range{2, 1000});
    visit("reviews",
          self.reviews,
          "times that clusters with a seam that does not hold are given more overlap and "
          "reconstructed again",
          Range{0, 10});
    visit("max_overlap",
          self.max_overlap,
          "images shared at a place after that, at most",
          Range{2, 10000});
    visit("max_condition",
          self.max_condition,
          "seams that determine their similarity worse by this condition number want more overlap",
          Range{1, 1e12});
  }
};

/// How many clusters a component of n images becomes: max(n / cluster_size, min(min_clusters, n /
/// min_cluster_size)), whoever will compute them. n / cluster_size is rounded to an even number
/// where clusters stay within a fifth of cluster_size (of an odd number of equal tasks, the last
/// keeps every second worker waiting), else to the nearest.
[[nodiscard]] uint32_t NumClusters(size_t num_images, const PartitionOptions& options);

/// Divides each connected component of the view graph into NumClusters and lets neighbours overlap.
///
/// METIS k-way with edge weight = inliers x spread (EdgeWeights) cuts it into parts of
/// about equal cost (ImageCosts); the interior of every cluster is connected. Wherever two clusters
/// meet images are then shared (GrowOverlap), until `overlap` are or no more are connected. Where
/// clusters hang together by seams alone that should not hold (ForecastSeam), the images shared
/// there are made dear to part and the division is repeated, up to three times; then such clusters
/// are joined as long as they have no more than 2.4 times cluster_size images. A cut that is left
/// says why it is weak (Seam::weakness). Clusters are sorted by their smallest interior image.
/// Images without an edge are in no cluster. InvalidArgument when an edge names an image that does
/// not exist, Internal when METIS fails.
[[nodiscard]] absl::StatusOr<Partition> PartitionViewGraph(const ViewGraph& graph,
                                                           const PartitionOptions& options);

/// The same with clusters by hand: images with an edge and of one name are the interior of one
/// cluster, connected or not. `cluster_of_image`: per image of the graph.
[[nodiscard]] absl::StatusOr<Partition> PartitionByHand(
    const ViewGraph& graph,
    const std::vector<std::string>& cluster_of_image,
    const PartitionOptions& options);

/// The clusters of `partition` where neighbours named in `requests` share as many images, wherever
/// they meet, as those ask for. Interiors stay. So do the images of all other clusters, and which
/// of them are shared, because what one cluster lends was shared by all who had it before.
[[nodiscard]] absl::StatusOr<Partition> WidenOverlaps(const ViewGraph& graph,
                                                      const Partition& partition,
                                                      const std::vector<OverlapRequest>& requests,
                                                      const PartitionOptions& options);

}  // namespace orbweave
