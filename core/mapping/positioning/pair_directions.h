// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "core/averaging/average_differences.h"
#include "core/base/stage_context.h"
#include "core/mapping/model/correspondence_graph.h"
#include "core/mapping/model/mapping_options.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// In which directions pairs see each other.
struct PairDirections {
  /// AverageRotations over all pairs, in a frame of their own; per image of the cluster.
  std::vector<Eigen::Quaterniond> cams_from_world{};
  /// Pairs with a direction whose rotation most others do not contradict: those that are off by
  /// more than two degrees are wrong.
  std::vector<ViewEdge> edges{};
  /// Of each edge, index into graph.pairs.
  std::vector<uint32_t> pairs{};

  /// The unit direction from image a of an edge to image b, in the world.
  [[nodiscard]] Eigen::Vector3d Direction(size_t edge) const {
    const ViewEdge& of = edges[edge];
    return cams_from_world[of.pair.a.value].conjugate() * of.b_from_a.Centre();
  }
};

/// Of all pairs of `available` images with enough inliers. Image ids of edges are the cluster's
/// slots.
[[nodiscard]] absl::StatusOr<PairDirections> FindPairDirections(const ClusterProblem& problem,
                                                                const CorrespondenceGraph& graph,
                                                                std::span<const uint8_t> available,
                                                                const MappingOptions& options,
                                                                const StageContext& context);

/// Displacements C_b - C_a in the world as a graph over the images of the cluster, of edges with
/// these `lengths`; those of length 0 are left out. A displacement is as exact as length / angle,
/// as noise of the rays turns a baseline the more the smaller the angles under which points see it.
[[nodiscard]] DifferenceGraph Displacements(const PairDirections& pairs,
                                            std::span<const double> lengths);

/// The largest set of images that edges join, ascending; of equal ones that of the lowest image.
/// Empty without edges.
[[nodiscard]] std::vector<ImageSlot> LargestPart(uint32_t num_images,
                                                 std::span<const GraphEdge> edges);

}  // namespace orbweave
