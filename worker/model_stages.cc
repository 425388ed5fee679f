// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "worker/model_stages.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "core/graph/build_view_graph.h"
#include "core/graph/drop_edges_against_chain.h"
#include "core/graph/drop_edges_against_gnss.h"
#include "core/graph/drop_edges_against_headings.h"
#include "core/graph/partition_view_graph.h"
#include "core/merging/review_seams.h"
#include "core/merging/rim.h"
#include "core/scene/view_edge_of.h"
#include "core/stages/assemble_cluster.h"
#include "core/stages/plan_recipes.h"
#include "proto/codec/features_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/recipes_codec.h"
#include "proto/codec/reconstruction_codec.h"
#include "proto/codec/two_view_codec.h"
#include "worker/stage_io.h"

namespace orbweave {
namespace {

/// Edges of all verified pairs, one blob open at a time.
struct CollectedEdges {
  std::vector<ViewEdge> edges{};
  std::map<ImagePair, Digest> blob_of_pair{};
};

absl::StatusOr<CollectedEdges> CollectEdges(const std::vector<Digest>& match_blobs,
                                            BlobAccess& blobs) {
  CollectedEdges collected;
  for (const Digest& digest : match_blobs) {
    ORBWEAVE_ASSIGN_OR_RETURN(const auto geometries,
                              FetchBlob(digest, blobs, DecodeTwoViewGeometries));
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

/// In the first round clusters by hand or by METIS, later those of the round before with more
/// overlap.
absl::StatusOr<Partition> DivideOrWiden(const TaskSpec& spec,
                                        const ViewGraph& graph,
                                        const ImageManifest& manifest,
                                        const PartitionOptions& options,
                                        BlobAccess& blobs) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterNames by_hand,
                            FetchInput(spec, 3, blobs, DecodeClusterNames));
  ORBWEAVE_ASSIGN_OR_RETURN(const DividedViewGraph before,
                            FetchInput(spec, 4, blobs, DecodeDividedViewGraph));
  ORBWEAVE_ASSIGN_OR_RETURN(const PartitionReview review,
                            FetchInput(spec, 5, blobs, DecodePartitionReview));
  if (!review.requests.empty())
    return WidenOverlaps(graph, before.partition, review.requests, options);
  if (by_hand.empty()) return PartitionViewGraph(graph, options);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::string> clusters,
                            ClusterOfImages(manifest, by_hand));
  return PartitionByHand(graph, clusters, options);
}

ClusterResult RimOfCluster(const ClusterResult& cluster, const std::vector<ImageId>& shared) {
  ClusterResult rim{.cluster = cluster.cluster};
  for (const Reconstruction& component : cluster.reconstruction.components)
    rim.reconstruction.components.push_back(RimOf(component, shared));
  return rim;
}

}  // namespace

absl::StatusOr<TaskResult> RunPartitionViewGraph(const TaskSpec& spec,
                                                 BlobAccess& blobs,
                                                 const StageContext&) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            FetchInput(spec, 0, blobs, DecodeImageManifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const ExtractedBlobs extracted,
                            FetchInput(spec, 1, blobs, SplitExtracted));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> match_blobs,
                            FetchInput(spec, 2, blobs, DecodeCollection));
  ORBWEAVE_ASSIGN_OR_RETURN(CollectedEdges collected, CollectEdges(match_blobs, blobs));
  EdgesByGnss by_gnss = DropEdgesAgainstGnss(collected.edges, manifest);
  EdgesByChain by_chain = DropEdgesAgainstChain(by_gnss.kept, manifest);
  FilteredViewGraph filtered = BuildViewGraph(
      static_cast<uint32_t>(manifest.images.size()), std::move(by_chain.kept), options.view_graph);
  EdgesByGnss by_heading = DropEdgesAgainstHeadings(filtered.graph.edges, manifest);
  filtered.graph.edges = std::move(by_heading.kept);
  DividedViewGraph divided{.dropped = std::move(by_gnss.dropped)};
  std::ranges::move(by_chain.dropped, std::back_inserter(divided.dropped));
  std::ranges::move(by_heading.dropped, std::back_inserter(divided.dropped));
  divided.dropped.insert(divided.dropped.end(), filtered.dropped.begin(), filtered.dropped.end());
  ORBWEAVE_ASSIGN_OR_RETURN(
      divided.partition, DivideOrWiden(spec, filtered.graph, manifest, options.partition, blobs));
  for (const ViewEdge& edge : filtered.graph.edges) {
    divided.edges.push_back(edge.pair);
    divided.edge_kinds.push_back(static_cast<uint8_t>(edge.kind));
    divided.edge_rungs.push_back(static_cast<uint8_t>(edge.rung));
  }

  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeDividedViewGraph(divided), blobs, result));
  const auto recipes = PlanClusters(
      divided.partition, filtered.graph, manifest, extracted.features, collected.blob_of_pair);
  ORBWEAVE_RETURN_IF_ERROR(PutRecipes(recipes, EncodeClusterRecipe, blobs, result));
  result.report_json = nlohmann::json{{"edges", divided.edges.size()},
                                      {"dropped_edges", divided.dropped.size()},
                                      {"clusters", divided.partition.clusters.size()}}
                           .dump();
  return result;
}

absl::StatusOr<TaskResult> RunReconstructCluster(const TaskSpec& spec,
                                                 BlobAccess& blobs,
                                                 const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterRecipe recipe,
                            FetchInput(spec, 0, blobs, DecodeClusterRecipe));
  ClusterProblem problem;
  for (const FeatureFile& file : recipe.images) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Features features,
                              FetchBlob(file.features, blobs, DecodeFeatures));
    problem.images.push_back(ToClusterImage(file.image, features));
  }
  for (const Digest& digest : recipe.matches) {
    ORBWEAVE_ASSIGN_OR_RETURN(auto geometries, FetchBlob(digest, blobs, DecodeTwoViewGeometries));
    TakePairs(recipe, std::move(geometries), problem);
  }
  TakeFixes(recipe, problem);
  ClusterResult cluster{.cluster = recipe.cluster};
  ORBWEAVE_ASSIGN_OR_RETURN(cluster.reconstruction,
                            ReconstructCluster(problem, options.mapping, context));
  const std::vector<Reconstruction>& components = cluster.reconstruction.components;

  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeClusterResult(cluster), blobs, result));
  ORBWEAVE_RETURN_IF_ERROR(
      PutOutput(EncodeClusterResult(RimOfCluster(cluster, recipe.shared)), blobs, result));
  size_t registered = 0;
  for (const Reconstruction& component : components) registered += component.images.size();
  result.report_json = nlohmann::json{{"images", problem.images.size()},
                                      {"registered", registered},
                                      {"components", components.size()},
                                      {"joined_components", cluster.reconstruction.num_joined},
                                      {"residual_rms_px", cluster.reconstruction.residual_rms_px},
                                      {"started_globally", cluster.reconstruction.started_globally},
                                      {"start_remark", cluster.reconstruction.start_remark}}
                           .dump();
  return result;
}

}  // namespace orbweave
