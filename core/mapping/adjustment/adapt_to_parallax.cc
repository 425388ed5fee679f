// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/adapt_to_parallax.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
constexpr double kUpperQuarter = 0.75;
constexpr double kShare = 1.0 / 3.0;
constexpr double kFloorPx = 0.5;  // as of errors (AdjustFinalModel): features are no more exact

/// Per node the largest angle to what it is matched with; negative without matches.
std::vector<double> WidestOfNodes(const ClusterProblem& problem, const CorrespondenceGraph& graph) {
  std::vector<double> widest_rad(graph.NumNodes(), -1.0);
  for (const LinkedPair& pair : graph.pairs) {
    const TwoViewGeometry& geometry = problem.pairs[pair.index];
    for (const FeatureMatch& match : geometry.inliers) {
      const Node a = graph.node_of_feature[pair.a][match.a];
      const Node b = graph.node_of_feature[pair.b][match.b];
      const double angle_rad = AngleBetween(geometry.b_from_a.rotation * graph.bearing_of_node[a],
                                            graph.bearing_of_node[b]);
      for (const Node node : {a, b}) widest_rad[node] = std::max(widest_rad[node], angle_rad);
    }
  }
  return widest_rad;
}

}  // namespace

double ParallaxOf(const ClusterProblem& problem, const CorrespondenceGraph& graph) {
  const std::vector<double> widest_rad = WidestOfNodes(problem, graph);
  std::vector<double> of_images;
  for (ImageSlot image = 0; image < graph.NumImages(); ++image) {
    std::vector<double> matched(widest_rad.begin() + graph.first_node[image],
                                widest_rad.begin() + graph.first_node[image + 1]);
    std::erase_if(matched, [](double angle_rad) { return angle_rad < 0.0; });
    if (!matched.empty()) of_images.push_back(Quantile(std::move(matched), kUpperQuarter));
  }
  return Quantile(std::move(of_images), kUpperQuarter);
}

MappingOptions AdaptToParallax(const ClusterProblem& problem,
                               const CorrespondenceGraph& graph,
                               MappingOptions options) {
  const double parallax_deg = kDegreesPerRadian * ParallaxOf(problem, graph);
  if (parallax_deg == 0.0) return options;
  const double pixel_deg = kDegreesPerRadian * problem.images.front().camera.AngleFromPixels(1.0);
  const double min_angle_deg = std::max(kShare * parallax_deg, kFloorPx * pixel_deg);
  if (min_angle_deg >= options.min_angle_deg) return options;
  options.min_angle_deg = min_angle_deg;
  options.max_error_px = std::min(options.max_error_px, min_angle_deg / pixel_deg);
  return options;
}

}  // namespace orbweave
