// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/mapping/model/cluster_problem.h"

namespace orbweave {

/// Position of an image in ClusterProblem::images.
using ImageSlot = uint32_t;

/// One ray of one image of the cluster: a feature, or several that share their bearing exactly (one
/// keypoint described under several orientations), which see one thing. Nodes of image 0 come
/// first, then those of image 1, ...; within an image in order of the first feature.
using Node = uint32_t;

/// A verified pair of the problem, by slots (a < b) instead of ids.
struct LinkedPair {
  ImageSlot a = 0;
  ImageSlot b = 0;
  uint32_t index = 0;  ///< into ClusterProblem::pairs

  /// The image beside `image`, one of the two.
  [[nodiscard]] ImageSlot Other(ImageSlot image) const { return image == a ? b : a; }
};

/// The verified matches of a cluster as a graph over rays, in compressed rows. Pairs of kind
/// kNone take no part; those of a pure rotation do: they join tracks although they give no depth.
struct CorrespondenceGraph {
  std::vector<Node> first_node{};                    ///< per image, and the total at the end
  std::vector<ImageSlot> image_of_node{};            ///< per node
  std::vector<FeatureIndex> feature_of_node{};       ///< per node, the first of those that share it
  std::vector<Eigen::Vector3d> bearing_of_node{};    ///< per node, unit, in the camera frame
  std::vector<std::vector<Node>> node_of_feature{};  ///< per image and feature
  std::vector<uint32_t> first_neighbour{};           ///< per node, and the total at the end
  std::vector<Node> neighbours{};                    ///< per node, ascending, each once
  std::vector<LinkedPair> pairs{};                   ///< sorted by (a, b)
  std::vector<std::vector<uint32_t>> pairs_of_image{};  ///< per image, indices into `pairs`

  [[nodiscard]] uint32_t NumImages() const { return static_cast<uint32_t>(pairs_of_image.size()); }
  [[nodiscard]] uint32_t NumNodes() const { return static_cast<uint32_t>(image_of_node.size()); }
  [[nodiscard]] std::span<const Node> Neighbours(Node node) const {
    return {neighbours.data() + first_neighbour[node],
            neighbours.data() + first_neighbour[node + 1]};
  }
};

/// Where the image is in the problem; nullopt: nowhere.
[[nodiscard]] std::optional<ImageSlot> SlotOf(const ClusterProblem& problem, ImageId id);

/// InvalidArgument when images are not sorted by id, a pair names an image that is not there, or a
/// match a feature that is not there.
[[nodiscard]] absl::StatusOr<CorrespondenceGraph> BuildCorrespondenceGraph(
    const ClusterProblem& problem);

}  // namespace orbweave
