// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/forecast_seam.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

std::vector<ImageId> ImagesFrom(uint32_t first, uint32_t end) {
  std::vector<ImageId> images;
  for (uint32_t i = first; i < end; ++i) images.emplace_back(i);
  return images;
}

/// Images 0 ... 19 and 20 ... 39 of a street, which lend each other six.
SeamForecast ForecastOf(const ViewGraph& graph) {
  const Seam seam{.cluster_a = 0, .cluster_b = 1, .shared = ImagesFrom(14, 26)};
  return ForecastSeam(graph,
                      Adjacency(graph.num_images, graph.edges),
                      seam,
                      {.images = ImagesFrom(0, 26), .interior = ImagesFrom(0, 20)},
                      {.images = ImagesFrom(14, 40), .interior = ImagesFrom(20, 40)});
}

TEST(ForecastSeam, TrustsAStreet) {
  const SeamForecast forecast = ForecastOf(Street(40, 4));
  EXPECT_EQ(forecast.firm, 12U);
  EXPECT_EQ(forecast.shared, 12U);
  EXPECT_NEAR(forecast.condition, 1.0 / std::pow(std::sin(0.2), 2), 1e-9);
  EXPECT_EQ(WeaknessOf(forecast, 1000.0), "");
}

TEST(ForecastSeam, KnowsWhatOneSideAloneWillRegister) {
  ViewGraph street = Street(40, 4);
  std::erase_if(street.edges, [](const ViewEdge& edge) {
    return edge.pair.a.value < 20 && edge.pair.b.value >= 20 && edge.pair.a.value != 19;
  });
  for (ViewEdge& edge : street.edges) {
    if (edge.pair.a.value == 19 && edge.pair.b.value >= 20) edge.num_inliers = 10;
  }
  const SeamForecast forecast = ForecastOf(street);
  EXPECT_EQ(forecast.firm, 0U) << "40 inliers across are too few for either side";
  EXPECT_EQ(WeaknessOf(forecast, 1000.0), "0 of 12 shared images have pairs enough on both sides");
}

TEST(ForecastSeam, SeesThatACameraWhichStandsTellsNoScale) {
  ViewGraph street = Street(40, 4);
  for (ViewEdge& edge : street.edges) edge.kind = TwoViewKind::kPureRotation;
  EXPECT_TRUE(std::isinf(ForecastOf(street).condition));
  for (ViewEdge& edge : street.edges) {
    edge.kind = TwoViewKind::kGeneral;
    edge.median_angle_rad = 0.01;
  }
  EXPECT_EQ(WeaknessOf(ForecastOf(street), 1000.0),
            "pairs of its shared images have hardly any parallax");
}

}  // namespace
}  // namespace orbweave
