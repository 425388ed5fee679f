// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/export_submodel.h"

#include <algorithm>

#include "core/mapping/adjustment/adjust_part.h"
#include "core/mapping/model/filter_points.h"

namespace orbweave {
namespace {

/// Sums the colours of a track's features.
struct ColorMean {
  uint32_t r = 0;
  uint32_t g = 0;
  uint32_t b = 0;
  uint32_t count = 0;

  void Add(const Rgb& color) {
    r += color.r;
    g += color.g;
    b += color.b;
    ++count;
  }
  [[nodiscard]] Rgb Mean() const {
    const auto mean = [&](uint32_t sum) { return static_cast<uint8_t>((sum + count / 2) / count); };
    return {mean(r), mean(g), mean(b)};
  }
};

Track ExportTrack(const MappingState& state, const MappedPoint& point) {
  const CorrespondenceGraph& graph = state.Graph();
  std::vector<Node> nodes = point.nodes;
  std::sort(nodes.begin(), nodes.end());  // node order is (image, feature) order
  Track track{.point_in_world = point.position};
  ColorMean color;
  for (const Node node : nodes) {
    const ClusterImage& image = state.Problem().images[graph.image_of_node[node]];
    const FeatureIndex feature = graph.feature_of_node[node];
    track.observations.push_back({.ref = {image.id, feature},
                                  .bearing = graph.bearing_of_node[node],
                                  .sigma_rad = NodeSigma(state, node)});
    color.Add(image.colors[feature]);
  }
  track.color = color.Mean();
  return track;
}

}  // namespace

Reconstruction ExportSubmodel(const MappingState& state) {
  Reconstruction reconstruction;
  for (const ImageSlot image : state.Registered()) {
    reconstruction.images[state.Problem().images[image].id] = {.cam_from_world =
                                                                   state.CamFromWorld(image)};
  }
  for (const PointIndex point : AllPoints(state)) {
    reconstruction.tracks.push_back(ExportTrack(state, state.Point(point)));
  }
  reconstruction.SortTracks();
  return reconstruction;
}

}  // namespace orbweave
