// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "core/base/random.h"
#include "core/graph/choose_edges.h"
#include "core/graph/partition_view_graph.h"
#include "core/mapping/cluster_reconstruction.h"
#include "core/mapping/model/cluster_problem.h"
#include "core/mapping/reconstruct_cluster.h"
#include "core/merging/alignment/alignment.h"
#include "core/merging/merge_submodels.h"
#include "core/scene/view_edge_of.h"
#include "core/synthetic/corridor.h"
#include "stages/match_images/match_image_pair.h"
#include "stages/reconstruct_cluster/assemble_cluster.h"
#include "tests/core/merging/adjust_globally.h"
#include "tests/core/merging/align_all.h"

namespace orbweave {

/// What a job on the matches of a corridor comes to, and what its report would say.
struct Orientated {
  std::vector<testing::GloballyAdjusted> worlds{};
  std::vector<ImagePair> contradicted_pairs{};
  std::vector<NotRegistered> not_registered{};  ///< per cluster
  std::vector<DroppedEdge> dropped_edges{};
  std::vector<SeamReport> seams{};

  /// Whether the report would say that parts of the job contradict each other.
  [[nodiscard]] bool NamesAContradiction() const {
    return !contradicted_pairs.empty() ||
           std::ranges::any_of(seams, [](const SeamReport& seam) { return !seam.used; });
  }
  [[nodiscard]] size_t NumRegistered() const {
    size_t n = 0;
    for (const testing::GloballyAdjusted& world : worlds) n += world.reconstruction.images.size();
    return n;
  }
};

namespace orientate_internal {

inline std::vector<TwoViewGeometry> Verify(const Corridor& corridor) {
  const std::vector<PairSide> sides(corridor.features.begin(), corridor.features.end());
  std::vector<TwoViewGeometry> geometries;
  for (const PairMatches& pair : corridor.pairs) {
    const uint32_t a = pair.pair.a.value;
    const uint32_t b = pair.pair.b.value;
    const StageContext context{.seed = Random((uint64_t{a} << 32) | b).Next()};
    auto geometry = MatchImagePair(pair.pair, sides[a], sides[b], {pair.matches}, {}, {}, context);
    EXPECT_TRUE(geometry.ok()) << geometry.status();
    if (geometry.ok()) geometries.push_back(*std::move(geometry));
  }
  return geometries;
}

inline ClusterProblem Problem(const Corridor& corridor,
                              const Cluster& cluster,
                              const ViewGraph& graph,
                              const std::vector<TwoViewGeometry>& geometries) {
  ClusterRecipe recipe;
  for (const ViewEdge& edge : graph.edges) {
    const bool has_both = std::ranges::binary_search(cluster.images, edge.pair.a) &&
                          std::ranges::binary_search(cluster.images, edge.pair.b);
    if (has_both) recipe.pairs.push_back(edge.pair);
  }
  ClusterProblem problem;
  for (const ImageId id : cluster.images) {
    problem.images.push_back(ToClusterImage(id, corridor.features[id.value]));
    problem.images.back().prior = corridor.manifest.At(id).prior;
  }
  TakePairs(recipe, geometries, problem);
  return problem;
}

}  // namespace orientate_internal

/// Verification, view graph, partition, clusters, alignment, merging and global adjustment, each
/// with its defaults, as the stages of a job do them.
inline Orientated Orientate(const Corridor& corridor, const PartitionOptions& options = {}) {
  const std::vector<TwoViewGeometry> geometries = orientate_internal::Verify(corridor);
  std::vector<ViewEdge> edges;
  for (const TwoViewGeometry& geometry : geometries) edges.push_back(ViewEdgeOf(geometry));
  ChosenEdges chosen = ChooseEdges(edges, corridor.manifest, {});
  const ViewGraph& graph = chosen.graph;
  Orientated result{.dropped_edges = std::move(chosen.dropped)};
  const Partition partition = PartitionViewGraph(graph, options).value();
  std::vector<Submodel> submodels;
  for (uint32_t c = 0; c < partition.clusters.size(); ++c) {
    const ClusterProblem problem =
        orientate_internal::Problem(corridor, partition.clusters[c], graph, geometries);
    ClusterReconstruction cluster = ReconstructCluster(problem, {}, {.seed = c + 1}).value();
    uint32_t submodel = 0;
    for (Reconstruction& each : cluster.submodels)
      submodels.push_back({c, submodel++, std::move(each)});
    std::ranges::copy(cluster.contradicted_pairs, std::back_inserter(result.contradicted_pairs));
    std::ranges::copy(cluster.not_registered, std::back_inserter(result.not_registered));
  }
  const Alignment alignment = testing::AlignAll(submodels).value();
  result.seams = alignment.seams;
  for (MergedWorld& world : MergeSubmodels(submodels, alignment)) {
    result.worlds.push_back(
        testing::AdjustGlobally(std::move(world.reconstruction), corridor.manifest, {}, {}, {})
            .value());
  }
  return result;
}

}  // namespace orbweave
