// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/rigid3.h"
#include "core/scene/ids.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// A TwoViewGeometry without its matches: an edge of the view graph.
struct ViewEdge {
  ImagePair pair{};
  TwoViewKind kind = TwoViewKind::kGeneral;
  Rigid3 b_from_a{};
  uint32_t num_inliers = 0;
  double median_angle_rad = 0.0;
  double spread = 0.0;
  MatchRung rung = MatchRung::kGiven;
};

/// Images joined by verified geometry. Edges sorted by pair.
struct ViewGraph {
  uint32_t num_images = 0;
  std::vector<ViewEdge> edges{};
};

/// A verified pair of whose two images no cluster, or no submodel of its cluster, has both: nothing
/// that was reconstructed took part of it, so that it bears witness of how all was put together.
struct CrossingPair {
  ImagePair pair{};
  Rigid3 b_from_a{};  ///< |translation| = 1
};

/// What spoke against an edge.
enum class DropCause : uint8_t {
  kGeometry = 0,  ///< it has none, or another edge of the pair is better
  kTriplets = 1,
  kGnss = 2,
  kSequence = 3,  ///< the drive between its images
};

/// An edge that was dropped, and why ("3 of 3 triplets do not close").
struct DroppedEdge {
  ImagePair pair{};
  std::string reason{};
  DropCause cause = DropCause::kGeometry;
};

/// Overlapping clusters of images. Every image of `graph` with an edge is interior to exactly one
/// cluster; an image in more than one cluster is a separator image of those clusters.
struct Cluster {
  std::vector<ImageId> images{};    ///< sorted: interior and overlap
  std::vector<ImageId> interior{};  ///< sorted: those that belong to this cluster first of all
};

struct Seam {
  uint32_t cluster_a = 0;  ///< < cluster_b
  uint32_t cluster_b = 0;
  std::vector<ImageId> shared{};  ///< images in both
  std::string weakness{};         ///< why it may not hold, as far as pairs tell; empty: it holds
};

struct Partition {
  std::vector<Cluster> clusters{};
  std::vector<Seam> seams{};  ///< sorted by (a, b), those with at least one shared image
};

/// Two clusters that are to share more images than others, and why.
struct OverlapRequest {
  uint32_t cluster_a = 0;  ///< < cluster_b
  uint32_t cluster_b = 0;
  uint32_t images = 0;
  std::string reason{};
};

}  // namespace orbweave
