// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/strong_links.h"

#include <gtest/gtest.h>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

// Images 0 and 1 of a strong pair, 2 and 3 of a weak one, and a pair between.
bool IsStrong(double pair_of_0_1, double pair_of_2_3, double between) {
  const ViewGraph graph{.num_images = 4, .edges = {Edge(0, 1), Edge(1, 2), Edge(2, 3)}};
  const Adjacency adjacency(graph.num_images, graph.edges);
  const std::vector<double> weights{pair_of_0_1, between, pair_of_2_3};
  const StrongLinks strong(adjacency, weights);
  const Adjacency::Link from_1 = adjacency.Of(1)[1];
  const Adjacency::Link from_2 = adjacency.Of(2)[0];
  EXPECT_EQ(from_1.image, 2U);
  EXPECT_EQ(from_2.image, 1U);
  EXPECT_EQ(strong.Has(1, from_1), strong.Has(2, from_2));
  return strong.Has(1, from_1);
}

TEST(StrongLinks, AreATenthOfTheStrongestOfEitherImage) {
  EXPECT_TRUE(IsStrong(100.0, 100.0, 11.0));
  EXPECT_FALSE(IsStrong(100.0, 100.0, 9.0));
  EXPECT_TRUE(IsStrong(100.0, 20.0, 9.0)) << "where texture is poor, poor pairs hold";
  EXPECT_FALSE(IsStrong(100.0, 20.0, 1.0));
}

}  // namespace
}  // namespace orbweave
