// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/complete_tracks.h"

namespace orbweave {
namespace {

bool CanJoin(const MappingState& state, PointIndex point, Node node, double max_error_px) {
  const ImageSlot image = state.Graph().image_of_node[node];
  return state.PointOf(node) == kNoPoint && state.IsRegistered(image) &&
         !state.IsSeenBy(point, image) &&
         IsExplained(state, state.Point(point).position, node, max_error_px);
}

void CompleteTrack(MappingState& state, PointIndex point, double max_error_px) {
  // Nodes that join are appended to the list that is being walked.
  for (size_t i = 0; i < state.Point(point).nodes.size(); ++i) {
    for (const Node other : state.Graph().Neighbours(state.Point(point).nodes[i])) {
      if (CanJoin(state, point, other, max_error_px)) state.AddObservation(point, other);
    }
  }
}

}  // namespace

uint32_t CompleteTracks(MappingState& state,
                        std::span<const PointIndex> points,
                        double max_error_px) {
  const uint32_t before = state.NumObservations();
  for (const PointIndex point : points) {
    if (state.Exists(point)) CompleteTrack(state, point, max_error_px);
  }
  return state.NumObservations() - before;
}

}  // namespace orbweave
