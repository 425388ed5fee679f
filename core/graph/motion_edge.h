// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/scene/image_manifest.h"
#include "core/scene/places_in_drives.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// Per image: where its camera looks, radians clockwise from what the azimuths of steps count from;
/// nullopt where nothing tells.
using Headings = std::vector<std::optional<double>>;

/// The step from the first image of an edge to the second, seen from above.
struct EdgeStep {
  double azimuth_rad = 0.0;  ///< from north by GNSS, or from the way of the drive
  double in_a_rad = 0.0;     ///< azimuth in camera a, and in camera b, which stand upright
  double in_b_rad = 0.0;
  double distance_m = 0.0;  ///< by the positions; 1 along the way
  double sigma_m = 0.0;     ///< of it, per axis

  [[nodiscard]] double HeadingOfA() const { return azimuth_rad - in_a_rad; }
  [[nodiscard]] double HeadingOfB() const { return azimuth_rad - in_b_rad; }
  /// Whether its azimuth says anything: by positions so far apart it is good to 23 degrees.
  [[nodiscard]] bool IsTelling() const { return distance_m > 2.5 * sigma_m; }
};

/// What an edge says of the headings of its cameras.
struct MotionEdge {
  uint32_t edge = 0;  ///< of those given
  uint32_t a = 0;
  uint32_t b = 0;
  /// The root of its inliers: those of one facade are right or wrong together.
  double weight = 0.0;
  bool is_in_sequence = false;     ///< its images are few places apart in one drive
  double turn_rad = 0.0;           ///< heading of a less heading of b
  std::optional<EdgeStep> step{};  ///< where both have positions and it has a direction
};

/// Of all edges that have a geometry, in their order; steps by GNSS.
[[nodiscard]] std::vector<MotionEdge> MotionEdgesOf(const std::vector<ViewEdge>& edges,
                                                    const ImageManifest& manifest,
                                                    const PlacesInDrives& places);

/// Of those in a sequence that have a direction, in their order: each step leads onward, azimuth 0
/// from the image that was taken earlier to the later one.
[[nodiscard]] std::vector<MotionEdge> MotionEdgesAlongWay(const std::vector<ViewEdge>& edges,
                                                          const PlacesInDrives& places);

/// How far the step of an edge is from where GNSS has it, or the way.
struct StepError {
  double at_a_rad = 0.0;  ///< between both, by the heading of a, and by that of b
  double at_b_rad = 0.0;
  /// By so much at least one of the positions would have to be wrong for the edge to be right,
  /// whatever its length.
  double miss_m = 0.0;

  [[nodiscard]] double Least() const { return std::min(at_a_rad, at_b_rad); }
};

/// nullopt where a heading or the step is not known.
[[nodiscard]] std::optional<StepError> StepErrorOf(const MotionEdge& edge,
                                                   const Headings& headings);

/// Between how the edge turns and how the headings do, in [0, pi]; nullopt where one is not known.
[[nodiscard]] std::optional<double> TurnErrorOf(const MotionEdge& edge, const Headings& headings);

/// Whether the edge turns otherwise than the headings. Headings are right to ten degrees, and
/// houses that look alike stand at right angles to each other where they are not parallel.
[[nodiscard]] bool TurnsOtherwise(const MotionEdge& edge, const Headings& headings);

}  // namespace orbweave
