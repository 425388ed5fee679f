// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/partition_view_graph/stage.h"

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/artifacts/check_bounds.h"
#include "core/graph/choose_edges.h"
#include "core/graph/crossing_pairs.h"
#include "core/graph/partition_view_graph.h"
#include "core/scene/view_edge_of.h"
#include "stages/codecs.h"
#include "stages/partition_view_graph/plan_clusters.h"

namespace orbweave {
namespace {

using Task = StageTask<PartitionViewGraphStage>;

/// Edges of all verified pairs, one blob open at a time.
struct CollectedEdges {
  std::vector<ViewEdge> edges{};
  std::map<ImagePair, Digest> blob_of_pair{};
};

absl::StatusOr<CollectedEdges> CollectEdges(const ImageManifest& manifest, Task& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> blobs,
                            task.Read(&PartitionViewGraphStage::verified));
  CollectedEdges collected;
  for (const Digest& digest : blobs) {
    ORBWEAVE_ASSIGN_OR_RETURN(const auto geometries,
                              task.Fetch<std::vector<TwoViewGeometry>>(digest));
    ORBWEAVE_RETURN_IF_ERROR(BlameBlob(CheckPairs(geometries, manifest), digest));
    for (const TwoViewGeometry& geometry : geometries) {
      collected.edges.push_back(ViewEdgeOf(geometry));
      collected.blob_of_pair[geometry.pair] = digest;
    }
  }
  return collected;
}

/// The cluster by hand of each image of the manifest.
absl::StatusOr<std::vector<std::string>> ClusterOfImages(const ImageManifest& manifest,
                                                         const ClusterNames& by_hand) {
  std::vector<std::string> clusters;
  for (const ImageRecord& image : manifest.images) {
    const auto found = by_hand.find(image.name);
    if (found == by_hand.end())
      return absl::InvalidArgumentError("clusters by hand: none is named for " + image.name);
    clusters.push_back(found->second);
  }
  return clusters;
}

absl::StatusOr<Partition> DivideOrWiden(const ViewGraph& graph,
                                        const ImageManifest& manifest,
                                        Task& task) {
  const PartitionOptions& options = task.options<PartitionOptions>();
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterNames by_hand,
                            task.Read(&PartitionViewGraphStage::clusters_by_hand));
  ORBWEAVE_ASSIGN_OR_RETURN(const DividedViewGraph before,
                            task.Read(&PartitionViewGraphStage::before));
  ORBWEAVE_ASSIGN_OR_RETURN(const PartitionReview review,
                            task.Read(&PartitionViewGraphStage::review));
  ORBWEAVE_RETURN_IF_ERROR(CheckPartition(before.partition, manifest));
  ORBWEAVE_RETURN_IF_ERROR(CheckRequests(review.requests, before.partition));
  if (!review.requests.empty())
    return WidenOverlaps(graph, before.partition, review.requests, options);
  if (by_hand.empty()) return PartitionViewGraph(graph, options);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::string> clusters,
                            ClusterOfImages(manifest, by_hand));
  return PartitionByHand(graph, clusters, options);
}

}  // namespace

absl::Status PartitionViewGraphStage::Run(StageTask<PartitionViewGraphStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            task.Read(&PartitionViewGraphStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const InterleavedDigests features,
                            task.Read(&PartitionViewGraphStage::features));
  if (features.first.size() != manifest.images.size())
    return DoesNotFit("not one Features blob for each image");
  ORBWEAVE_ASSIGN_OR_RETURN(const CollectedEdges collected, CollectEdges(manifest, task));
  ChosenEdges chosen = ChooseEdges(collected.edges, manifest, task.options<ViewGraphOptions>());
  DividedViewGraph divided{.dropped = std::move(chosen.dropped)};
  ORBWEAVE_ASSIGN_OR_RETURN(divided.partition, DivideOrWiden(chosen.graph, manifest, task));
  for (const ViewEdge& edge : chosen.graph.edges) {
    divided.edges.push_back(edge.pair);
    divided.edge_kinds.push_back(static_cast<uint8_t>(edge.kind));
    divided.edge_rungs.push_back(static_cast<uint8_t>(edge.rung));
  }
  divided.crossing = CrossingPairs(chosen.graph, divided.partition);
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::divided, divided).status());
  ORBWEAVE_RETURN_IF_ERROR(task.LeaveAll(
      &Outputs::clusters,
      PlanClusters(
          divided.partition, chosen.graph, manifest, features.first, collected.blob_of_pair)));
  task.Report(nlohmann::json{{"edges", divided.edges.size()},
                             {"dropped_edges", divided.dropped.size()},
                             {"clusters", divided.partition.clusters.size()}}
                  .dump());
  return absl::OkStatus();
}

}  // namespace orbweave
