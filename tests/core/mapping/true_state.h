// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mapping/model/filter_points.h"
#include "core/mapping/model/mapping_state.h"
#include "core/mapping/model/triangulate_tracks.h"
#include "tests/core/mapping/ray_street.h"

namespace orbweave {

/// A street and its graph, in a place that states may refer to.
struct StreetFixture {
  explicit StreetFixture(const RayStreetOptions& options)
      : world(MakeStreet(options)), graph(BuildCorrespondenceGraph(world.problem).value()) {}

  StreetFixture(const StreetFixture&) = delete;
  StreetFixture& operator=(const StreetFixture&) = delete;

  /// A state in which the given images stand where they truly are; no points yet.
  [[nodiscard]] MappingState StateWith(const std::vector<ImageSlot>& images) const {
    MappingState state(world.problem, graph);
    for (const ImageSlot image : images) state.Register(image, world.cams_from_world[image]);
    return state;
  }

  /// The same, with points from all their matches.
  [[nodiscard]] MappingState TriangulatedStateWith(const std::vector<ImageSlot>& images) const {
    MappingState state = StateWith(images);
    for (const ImageSlot image : images) TriangulateImage(state, image, TrackLimits{});
    return state;
  }

  /// The scene point that a node truly shows.
  [[nodiscard]] int TruePoint(Node node) const {
    return world.point_of_feature[graph.image_of_node[node]][graph.feature_of_node[node]];
  }

  RayStreet world;
  CorrespondenceGraph graph;
};

/// The same model in another unit of length.
inline void Scale(MappingState& state, double factor) {
  for (const ImageSlot image : state.Registered()) {
    Rigid3 pose = state.CamFromWorld(image);
    pose.translation *= factor;
    state.SetPose(image, pose);
  }
  for (const PointIndex point : AllPoints(state))
    state.SetPosition(point, factor * state.Point(point).position);
}

inline std::vector<ImageSlot> FirstImages(uint32_t count) {
  std::vector<ImageSlot> images;
  for (ImageSlot image = 0; image < count; ++image) images.push_back(image);
  return images;
}

}  // namespace orbweave
