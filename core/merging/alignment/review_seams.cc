// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/review_seams.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace orbweave {
namespace {

// A cluster of which no world holds this share fell apart.
constexpr double kWholeShare = 0.5;

using ClusterPair = std::pair<uint32_t, uint32_t>;

/// Images that two clusters lend each other: those interior to one of them. Others came to both
/// from third clusters.
uint32_t NumLent(const Partition& partition, const Seam& seam) {
  const auto is_lent = [&](ImageId image) {
    return std::ranges::binary_search(partition.clusters[seam.cluster_a].interior, image) ||
           std::ranges::binary_search(partition.clusters[seam.cluster_b].interior, image);
  };
  return static_cast<uint32_t>(std::ranges::count_if(seam.shared, is_lent));
}

/// Per cluster the most images that its submodels have in one world.
std::vector<uint32_t> LargestShares(size_t num_clusters, const Alignment& alignment) {
  std::map<ClusterPair, uint32_t> images;  // (cluster, world)
  for (size_t m = 0; m < alignment.submodels.size(); ++m) {
    const SubmodelExtent& submodel = alignment.submodels[m];
    images[{submodel.cluster, alignment.world[m]}] += submodel.num_images;
  }
  std::vector<uint32_t> largest(num_clusters, 0);
  for (const auto& [key, count] : images) largest[key.first] = std::max(largest[key.first], count);
  return largest;
}

std::string PieceText(uint32_t cluster, uint32_t registered, size_t num_images) {
  return "cluster " + std::to_string(cluster) + " fell apart: " + std::to_string(registered) +
         " of its " + std::to_string(num_images) + " images hang together";
}

/// Why each cluster that fell apart did not hold; empty for the others.
std::vector<std::string> FindBrokenClusters(const Partition& partition,
                                            const Alignment& alignment) {
  const std::vector<uint32_t> largest = LargestShares(partition.clusters.size(), alignment);
  std::vector<std::string> reasons(largest.size());
  for (uint32_t c = 0; c < largest.size(); ++c) {
    const size_t num_images = partition.clusters[c].images.size();
    if (largest[c] < kWholeShare * static_cast<double>(num_images))
      reasons[c] = PieceText(c, largest[c], num_images);
  }
  return reasons;
}

/// The similarities between two clusters' submodels.
std::map<ClusterPair, std::vector<const SeamReport*>> ReportsOfClusters(
    const Alignment& alignment) {
  std::map<ClusterPair, std::vector<const SeamReport*>> reports;
  for (const SeamReport& report : alignment.seams) {
    const uint32_t a = alignment.submodels[report.submodel_a].cluster;
    const uint32_t b = alignment.submodels[report.submodel_b].cluster;
    if (a != b) reports[std::minmax(a, b)].push_back(&report);
  }
  return reports;
}

/// Why no similarity of a seam holds; empty when one does, or when more overlap would not help.
std::string FindWeakness(const std::vector<const SeamReport*>& reports, double max_condition) {
  if (reports.empty()) return "their models have no common image";
  std::string reason;
  uint32_t most_tracks = 0;
  for (const SeamReport* report : reports) {
    if (report->contradicted) return "";
    if (report->used && report->condition_number <= max_condition) return "";
    if (!reason.empty() && report->common_tracks <= most_tracks) continue;
    most_tracks = report->common_tracks;
    reason = report->used ? "their similarity has condition number " +
                                std::to_string(std::lround(report->condition_number))
                          : report->reason;
  }
  return reason;
}

}  // namespace

PartitionReview ReviewSeams(const Partition& partition,
                            const Alignment& alignment,
                            PartitionReview before,
                            const PartitionOptions& options) {
  if (before.rounds >= static_cast<uint32_t>(options.reviews)) return before;
  const std::vector<std::string> broken = FindBrokenClusters(partition, alignment);
  auto reports = ReportsOfClusters(alignment);
  std::map<ClusterPair, OverlapRequest> requests;
  for (OverlapRequest& request : before.requests) {
    requests[{request.cluster_a, request.cluster_b}] = std::move(request);
  }
  const auto max_overlap = static_cast<uint32_t>(options.max_overlap);
  bool anybody_asks = false;
  for (const Seam& seam : partition.seams) {
    const ClusterPair pair{seam.cluster_a, seam.cluster_b};
    const auto asked = requests.find(pair);
    const uint32_t target =
        asked == requests.end() ? static_cast<uint32_t>(options.overlap) : asked->second.images;
    if (target >= max_overlap || NumLent(partition, seam) < target) continue;
    std::string reason = broken[pair.first];
    if (reason.empty()) reason = broken[pair.second];
    if (reason.empty()) reason = FindWeakness(reports[pair], options.max_condition);
    if (reason.empty()) continue;
    requests[pair] = {pair.first, pair.second, std::min(2 * target, max_overlap), reason};
    anybody_asks = true;
  }
  PartitionReview review{.rounds = before.rounds + (anybody_asks ? 1U : 0U)};
  for (auto& [pair, request] : requests) review.requests.push_back(std::move(request));
  return review;
}

}  // namespace orbweave
