// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/forecast_seam.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

namespace orbweave {
namespace {

// A panorama is registered from 20 points on, of which a third of the inliers of its pairs become
// any: points that two others saw before.
constexpr uint32_t kFirmInliers = 60;
constexpr uint32_t kMinFirm = 3;

using ImageSet = std::set<ImageId>;

// Shared images that the cluster registers, when its interior stands.
ImageSet Registered(const ViewGraph& graph,
                    const Adjacency& adjacency,
                    const Seam& seam,
                    const Cluster& cluster) {
  ImageSet standing(cluster.interior.begin(), cluster.interior.end());
  ImageSet registered;
  for (const ImageId image : seam.shared) {
    if (standing.contains(image)) registered.insert(image);
  }
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (const ImageId image : seam.shared) {
      if (registered.contains(image)) continue;
      uint32_t inliers = 0;
      for (const Adjacency::Link& link : adjacency.Of(image.value)) {
        if (standing.contains(ImageId(link.image))) inliers += graph.edges[link.edge].num_inliers;
      }
      if (inliers < kFirmInliers) continue;
      registered.insert(image);
      standing.insert(image);
      goes_on = true;
    }
  }
  return registered;
}

double ConditionOf(const ViewGraph& graph, const Adjacency& adjacency, const ImageSet& images) {
  double rotation = 0.0;
  double scale = 0.0;
  for (const ImageId image : images) {
    for (const Adjacency::Link& link : adjacency.Of(image.value)) {
      if (link.image < image.value || !images.contains(ImageId(link.image))) continue;
      const ViewEdge& edge = graph.edges[link.edge];
      rotation += edge.num_inliers;
      if (edge.kind == TwoViewKind::kPureRotation) continue;
      scale += edge.num_inliers * std::pow(std::sin(edge.median_angle_rad), 2);
    }
  }
  return scale > 0.0 ? rotation / scale : std::numeric_limits<double>::infinity();
}

}  // namespace

SeamForecast ForecastSeam(const ViewGraph& graph,
                          const Adjacency& adjacency,
                          const Seam& seam,
                          const Cluster& cluster_a,
                          const Cluster& cluster_b) {
  const ImageSet in_a = Registered(graph, adjacency, seam, cluster_a);
  const ImageSet in_b = Registered(graph, adjacency, seam, cluster_b);
  ImageSet firm;
  std::ranges::set_intersection(in_a, in_b, std::inserter(firm, firm.end()));
  return {.firm = static_cast<uint32_t>(firm.size()),
          .shared = static_cast<uint32_t>(seam.shared.size()),
          .condition = ConditionOf(graph, adjacency, firm)};
}

std::string WeaknessOf(const SeamForecast& forecast, double max_condition) {
  if (forecast.firm < kMinFirm)
    return std::to_string(forecast.firm) + " of " + std::to_string(forecast.shared) +
           " shared images have pairs enough on both sides";
  if (forecast.condition > max_condition)
    return "pairs of its shared images have hardly any parallax";
  return "";
}

}  // namespace orbweave
