// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/choose_edges.h"

#include <gtest/gtest.h>

#include <set>

#include "core/geometry/rotation.h"
#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

constexpr double kStep_m = 8.0;

/// A straight drive without turns whose positions are known to a metre.
ImageManifest ManifestOf(uint32_t num_images) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < num_images; ++i) {
    ImageRecord image{.id = ImageId(i)};
    image.prior.position_in_enu = Eigen::Vector3d(kStep_m * i, 0.0, 0.0);
    image.prior.horizontal_sigma_m = 1.0;
    manifest.images.push_back(image);
  }
  return manifest;
}

/// Its edges: no turn, and a step backwards in the frame of the next camera.
std::vector<ViewEdge> EdgesOf(uint32_t num_images, uint32_t window = 3) {
  std::vector<ViewEdge> edges = Street(num_images, window).edges;
  for (ViewEdge& edge : edges) edge.b_from_a.translation = -Eigen::Vector3d::UnitX();
  return edges;
}

TEST(ChooseEdges, KeepsWhatContradictsNothing) {
  const std::vector<ViewEdge> edges = EdgesOf(30);
  const ChosenEdges chosen = ChooseEdges(edges, ManifestOf(30), {});
  EXPECT_EQ(chosen.graph.num_images, 30U);
  EXPECT_EQ(chosen.graph.edges.size(), edges.size());
  EXPECT_TRUE(chosen.dropped.empty());
}

TEST(ChooseEdges, DropsWhatAnyOfItsFiltersDropsAndLosesNothing) {
  std::vector<ViewEdge> edges = EdgesOf(30);
  const ImagePair far = MakePair(ImageId(0), ImageId(29));
  edges.push_back(Edge(0, 29));
  edges.back().b_from_a.translation = -Eigen::Vector3d::UnitX();
  ImagePair turned;
  ImagePair backward;
  for (ViewEdge& edge : edges) {
    if (edge.pair == MakePair(ImageId(10), ImageId(12))) {
      turned = edge.pair;
      edge.b_from_a.rotation = RotationFromVector(Eigen::Vector3d(0.0, 1.0, 0.0));
    }
    if (edge.pair == MakePair(ImageId(20), ImageId(21))) {
      backward = edge.pair;
      edge.b_from_a.translation *= -1.0;
    }
  }
  const ChosenEdges chosen = ChooseEdges(edges, ManifestOf(30), {});
  EXPECT_EQ(PairsOf(chosen.dropped), (std::set<ImagePair>{far, turned, backward}));
  EXPECT_EQ(chosen.graph.edges.size() + chosen.dropped.size(), edges.size());
}

TEST(ChooseEdges, PositionsThatTheirDriveContradictsSpeakAgainstNoPair) {
  std::vector<ViewEdge> edges = EdgesOf(30, 1);
  const ImagePair look_alike = MakePair(ImageId(15), ImageId(25));
  edges.push_back(Edge(15, 25));
  ImageManifest manifest = ManifestOf(30);
  for (ImageRecord& image : manifest.images) image.capture_time_s = image.id.value;
  // Both stand beside the place that looks alike, and the two steps to them are 80 m too long.
  for (const uint32_t i : {15U, 16U})
    manifest.images[i].prior.position_in_enu->x() += 10.0 * kStep_m;
  EXPECT_EQ(PairsOf(ChooseEdges(edges, manifest, {}).dropped), std::set<ImagePair>{look_alike});
}

TEST(ChooseEdges, WhatLooksLikeAPlaceFarOffIsDroppedOfImagesWithoutAPositionToo) {
  ImageManifest manifest = ManifestOf(60);
  for (uint32_t i = 40; i < 46; ++i) manifest.images[i].prior.position_in_enu.reset();
  std::vector<ViewEdge> edges = EdgesOf(60);
  for (const uint32_t like : {3U, 4U}) {
    edges.push_back(Edge(like, like + 39));
    edges.back().b_from_a.translation = -Eigen::Vector3d::UnitX();
  }
  const ChosenEdges chosen = ChooseEdges(edges, manifest, {});
  EXPECT_EQ(PairsOf(chosen.dropped),
            (std::set{MakePair(ImageId(3), ImageId(42)), MakePair(ImageId(4), ImageId(43))}));
}

}  // namespace
}  // namespace orbweave
