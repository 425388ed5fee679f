// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/view_graph_weights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

TEST(EdgeWeights, AreInliersTimesSpreadAndNeverZero) {
  ViewGraph graph{.num_images = 3, .edges = {Edge(0, 1, 100), Edge(0, 2, 0)}};
  graph.edges[1].spread = 0.0;
  EXPECT_THAT(EdgeWeights(graph), ElementsAre(DoubleEq(50.0), DoubleEq(1.0 / 64.0)));
}

}  // namespace
}  // namespace orbweave
