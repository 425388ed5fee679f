// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/partition_view_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/graph/disjoint_sets.h"
#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

Partition Divided(const ViewGraph& graph, const PartitionOptions& options = {}) {
  const auto partition = PartitionViewGraph(graph, options);
  EXPECT_TRUE(partition.ok()) << partition.status();
  return partition.ok() ? *partition : Partition{};
}

bool AreConnected(const ViewGraph& graph, const std::vector<ImageId>& images) {
  const std::set<ImageId> members(images.begin(), images.end());
  DisjointSets sets(graph.num_images);
  for (const ViewEdge& edge : graph.edges) {
    if (members.contains(edge.pair.a) && members.contains(edge.pair.b)) {
      sets.Unite(edge.pair.a.value, edge.pair.b.value);
    }
  }
  return sets.SizeOf(images.front().value) == images.size();
}

bool Touch(const ViewGraph& graph, const Cluster& x, const Cluster& y) {
  const auto has = [](const Cluster& cluster, ImageId image) {
    return std::binary_search(cluster.interior.begin(), cluster.interior.end(), image);
  };
  return std::any_of(graph.edges.begin(), graph.edges.end(), [&](const ViewEdge& edge) {
    return (has(x, edge.pair.a) && has(y, edge.pair.b)) ||
           (has(y, edge.pair.a) && has(x, edge.pair.b));
  });
}

// What the scene promises of every partition.
void ExpectLawful(const ViewGraph& graph,
                  const Partition& partition,
                  const PartitionOptions& options) {
  std::map<ImageId, int> interior_count;
  std::map<std::pair<uint32_t, uint32_t>, std::vector<ImageId>> seams;
  for (const Seam& seam : partition.seams) seams[{seam.cluster_a, seam.cluster_b}] = seam.shared;
  for (uint32_t c = 0; c < partition.clusters.size(); ++c) {
    const Cluster& cluster = partition.clusters[c];
    EXPECT_TRUE(std::is_sorted(cluster.images.begin(), cluster.images.end()));
    EXPECT_TRUE(std::includes(cluster.images.begin(),
                              cluster.images.end(),
                              cluster.interior.begin(),
                              cluster.interior.end()));
    EXPECT_TRUE(AreConnected(graph, cluster.interior)) << "cluster " << c;
    EXPECT_TRUE(AreConnected(graph, cluster.images)) << "cluster " << c;
    for (const ImageId image : cluster.interior) ++interior_count[image];
    if (c > 0) {
      EXPECT_LT(partition.clusters[c - 1].interior.front(), cluster.interior.front());
    }
    for (uint32_t d = c + 1; d < partition.clusters.size(); ++d) {
      const Cluster& other = partition.clusters[d];
      std::vector<ImageId> shared;
      std::set_intersection(cluster.images.begin(),
                            cluster.images.end(),
                            other.images.begin(),
                            other.images.end(),
                            std::back_inserter(shared));
      const auto seam = seams.find({c, d});
      EXPECT_EQ(seam == seams.end() ? std::vector<ImageId>{} : seam->second, shared);
      if (!Touch(graph, cluster, other)) continue;
      const size_t available = cluster.interior.size() + other.interior.size();
      EXPECT_GE(shared.size(), std::min<size_t>(static_cast<size_t>(options.overlap), available));
    }
  }
  std::set<ImageId> joined;
  for (const ViewEdge& edge : graph.edges) joined.insert({edge.pair.a, edge.pair.b});
  EXPECT_EQ(interior_count.size(), joined.size());
  for (const auto& [image, count] : interior_count) EXPECT_EQ(count, 1) << "image " << image.value;
}

TEST(PartitionViewGraph, LeavesASmallJobInOneCluster) {
  for (const uint32_t n : {2, 11, 48, 140}) {
    const Partition partition = Divided(Street(n, 10));
    ASSERT_EQ(partition.clusters.size(), 1U) << n;
    EXPECT_EQ(partition.clusters[0].images.size(), n);
    EXPECT_TRUE(partition.seams.empty());
  }
}

// Whatever of a block two clusters have, one cannot be bent between the places where they meet.
TEST(PartitionViewGraph, HoldsTwoHalvesOfABlockTogetherAtBothEnds) {
  const ViewGraph loop = Loop(160, 3);
  const Partition partition = Divided(loop);
  ASSERT_EQ(partition.clusters.size(), 2U);
  ExpectLawful(loop, partition, {});
  const std::vector<ImageId>& shared = partition.seams.at(0).shared;
  EXPECT_EQ(shared.size(), 24U);
  for (const ViewEdge& edge : loop.edges) {
    const bool is_within = std::ranges::any_of(partition.clusters, [&](const Cluster& cluster) {
      return std::ranges::binary_search(cluster.images, edge.pair.a) &&
             std::ranges::binary_search(cluster.images, edge.pair.b);
    });
    EXPECT_TRUE(is_within) << edge.pair.a.value << " - " << edge.pair.b.value;
  }
}

TEST(PartitionViewGraph, DividesALoopOf48IntoThreeClustersInARing) {
  const ViewGraph loop = Loop(48, 10);
  const Partition partition = Divided(loop, {.min_clusters = 3});
  EXPECT_EQ(partition.clusters.size(), 3U);
  EXPECT_EQ(partition.seams.size(), 3U);
  ExpectLawful(loop, partition, {});
}

TEST(PartitionViewGraph, DividesACorridorByClusterSize) {
  const ViewGraph street = Street(500, 10);
  const Partition partition = Divided(street);
  EXPECT_EQ(partition.clusters.size(), 6U);
  EXPECT_EQ(partition.seams.size(), 5U);
  ExpectLawful(street, partition, {});
  for (const Seam& seam : partition.seams) EXPECT_EQ(seam.shared.size(), 12U);
}

TEST(PartitionViewGraph, MakesAnEvenNumberOfClustersWhereTheyStayNearTheirSize) {
  for (uint32_t n = 340; n < 2000; n += 83) {
    const size_t clusters = Divided(Street(n, 2)).clusters.size();
    EXPECT_EQ(clusters % 2, 0U) << n;
    EXPECT_GE(n, 80 * clusters) << n;
    EXPECT_LE(n, 120 * clusters) << n;
  }
  EXPECT_EQ(Divided(Street(300, 2)).clusters.size(), 3U) << "two or four would be far from it";
}

TEST(PartitionViewGraph, DividesCrossingStreets) {
  const ViewGraph grid = Grid(20);
  const PartitionOptions options{.cluster_size = 50};
  const Partition partition = Divided(grid, options);
  EXPECT_GE(partition.clusters.size(), 6U);
  ExpectLawful(grid, partition, options);
}

TEST(PartitionViewGraph, HandlesEveryComponentByItself) {
  ViewGraph graph = Street(120, 5);
  std::erase_if(graph.edges, [](const ViewEdge& edge) {
    return edge.pair.a < ImageId(64) && edge.pair.b >= ImageId(64);
  });
  const PartitionOptions options{.cluster_size = 30, .overlap = 6};
  const Partition partition = Divided(graph, options);
  ExpectLawful(graph, partition, options);
  for (const Cluster& cluster : partition.clusters) {
    EXPECT_EQ(cluster.images.front() < ImageId(64), cluster.images.back() < ImageId(64));
  }
}

TEST(PartitionViewGraph, LeavesOutImagesWithoutAnEdge) {
  ViewGraph graph = Street(20, 3);
  graph.num_images = 25;
  const Partition partition = Divided(graph);
  ASSERT_EQ(partition.clusters.size(), 1U);
  EXPECT_EQ(partition.clusters[0].images.back(), ImageId(19));
  EXPECT_TRUE(Divided({.num_images = 1}).clusters.empty());
  EXPECT_TRUE(Divided({}).clusters.empty());
}

TEST(PartitionViewGraph, KeepsChainsLawful) {
  const ViewGraph chain = Street(64, 1);
  const Partition partition = Divided(chain, {.min_clusters = 3});
  EXPECT_EQ(partition.clusters.size(), 3U);
  ExpectLawful(chain, partition, {});
}

TEST(PartitionViewGraph, DoesNotDivideWhenToldNotTo) {
  EXPECT_EQ(Divided(Street(500, 5), {.cluster_size = 0}).clusters.size(), 1U);
}

/// A street of which no pair across these places has more than so many inliers.
ViewGraph Thinned(ViewGraph street, const std::set<uint32_t>& places, uint32_t num_inliers) {
  for (ViewEdge& edge : street.edges) {
    const auto place = places.upper_bound(edge.pair.a.value);
    if (place != places.end() && *place <= edge.pair.b.value) edge.num_inliers = num_inliers;
  }
  return street;
}

TEST(PartitionViewGraph, CutsBesideAPlaceWhereNoSeamWouldHold) {
  const ViewGraph street = Thinned(Street(200, 6), {100}, 2);
  const PartitionOptions options{.cluster_size = 50};
  const Partition partition = Divided(street, options);
  EXPECT_GE(partition.clusters.size(), 3U);
  ExpectLawful(street, partition, options);
  for (const Seam& seam : partition.seams) EXPECT_EQ(seam.weakness, "");
  for (const Cluster& cluster : partition.clusters) {
    EXPECT_EQ(std::ranges::binary_search(cluster.interior, ImageId(99)),
              std::ranges::binary_search(cluster.interior, ImageId(100)));
  }
}

TEST(PartitionViewGraph, LetsAClusterGrowRatherThanCutWhereNothingHolds) {
  std::set<uint32_t> everywhere;
  for (uint32_t i = 1; i < 100; ++i) everywhere.insert(i);
  const ViewGraph street = Thinned(Street(100, 3), everywhere, 4);
  EXPECT_EQ(Divided(street, {.cluster_size = 50}).clusters.size(), 1U);
  const Partition partition = Divided(street, {.cluster_size = 25});
  EXPECT_EQ(partition.clusters.size(), 2U);
  ASSERT_EQ(partition.seams.size(), 1U) << "four times the size is too much";
  EXPECT_NE(partition.seams[0].weakness.find("shared images have pairs enough on both sides"),
            std::string::npos)
      << partition.seams[0].weakness;
}

TEST(PartitionViewGraph, GivesTheSameAnswerTwice) {
  const ViewGraph grid = Grid(15);
  const Partition first = Divided(grid, {.cluster_size = 30});
  const Partition second = Divided(grid, {.cluster_size = 30});
  ASSERT_EQ(first.clusters.size(), second.clusters.size());
  for (size_t c = 0; c < first.clusters.size(); ++c) {
    EXPECT_EQ(first.clusters[c].images, second.clusters[c].images);
  }
}

/// Images that the seam of clusters a and b lends, whichever way.
size_t NumLent(const Partition& partition, uint32_t a, uint32_t b) {
  const auto is_interior = [&](uint32_t cluster, ImageId image) {
    return std::ranges::binary_search(partition.clusters[cluster].interior, image);
  };
  for (const Seam& seam : partition.seams) {
    if (seam.cluster_a != a || seam.cluster_b != b) continue;
    return static_cast<size_t>(std::ranges::count_if(seam.shared, [&](ImageId image) {
      return is_interior(a, image) || is_interior(b, image);
    }));
  }
  return 0;
}

TEST(PartitionByHand, TakesTheClustersGivenAndGrowsTheirOverlap) {
  ViewGraph street = Street(60, 4);
  street.num_images = 61;
  std::vector<std::string> names;
  for (uint32_t i = 0; i < 61; ++i) names.emplace_back(i < 20 ? "zebra" : i < 50 ? "ant" : "owl");
  const PartitionOptions options{.overlap = 6};
  const auto partition = PartitionByHand(street, names, options);
  ASSERT_TRUE(partition.ok()) << partition.status();
  ASSERT_EQ(partition->clusters.size(), 3U);
  ExpectLawful(street, *partition, options);
  EXPECT_EQ(partition->clusters[0].interior.size(), 20U) << "in order of images, not of names";
  EXPECT_EQ(partition->clusters[1].interior.size(), 30U);
  EXPECT_EQ(partition->clusters[2].interior.size(), 10U) << "image 60 has no edge";
  EXPECT_EQ(NumLent(*partition, 0, 1), 6U);
}

TEST(PartitionByHand, AcceptsAClusterOfUnconnectedPieces) {
  std::vector<std::string> names(30, "a");
  for (uint32_t i = 10; i < 20; ++i) names[i] = "b";
  const auto partition = PartitionByHand(Street(30, 3), names, {.overlap = 4});
  ASSERT_TRUE(partition.ok()) << partition.status();
  ASSERT_EQ(partition->clusters.size(), 2U);
  EXPECT_EQ(partition->clusters[0].interior.size(), 20U);
  EXPECT_EQ(NumLent(*partition, 0, 1), 2U * 4U) << "b lies between, and meets a at two places";
}

TEST(WidenOverlaps, GrowsTheSeamsThatAskAndNoOtherCluster) {
  const ViewGraph grid = Grid(20);
  const PartitionOptions options{.cluster_size = 50, .overlap = 6};
  const Partition before = Divided(grid, options);
  ASSERT_EQ(NumLent(before, 0, 1), 6U);
  const auto after =
      WidenOverlaps(grid, before, {{.cluster_a = 0, .cluster_b = 1, .images = 12}}, options);
  ASSERT_TRUE(after.ok()) << after.status();
  ExpectLawful(grid, *after, options);
  EXPECT_EQ(NumLent(*after, 0, 1), 12U);
  for (uint32_t c = 0; c < before.clusters.size(); ++c) {
    const std::vector<ImageId>& old_images = before.clusters[c].images;
    EXPECT_EQ(after->clusters[c].interior, before.clusters[c].interior);
    EXPECT_TRUE(std::ranges::includes(after->clusters[c].images, old_images)) << c;
    EXPECT_EQ(after->clusters[c].images.size() > old_images.size(), c < 2) << c;
  }
}

TEST(WidenOverlaps, WithoutRequestsChangesNothing) {
  const ViewGraph street = Street(200, 6);
  const Partition before = Divided(street);
  const auto after = WidenOverlaps(street, before, {}, {});
  ASSERT_TRUE(after.ok()) << after.status();
  for (size_t c = 0; c < before.clusters.size(); ++c) {
    EXPECT_EQ(after->clusters[c].images, before.clusters[c].images);
  }
}

TEST(PartitionViewGraph, RefusesEdgesOfImagesThatAreNotThere) {
  const ViewGraph graph{.num_images = 3, .edges = {Edge(1, 3)}};
  EXPECT_EQ(PartitionViewGraph(graph, {}).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace orbweave
