// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/motion_edge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/graph/azimuth.h"
#include "core/graph/in_sequence.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr double kTurnsOtherwise_rad = std::numbers::pi / 3.0;

std::optional<EdgeStep> StepOf(const ViewEdge& edge, const ImageManifest& manifest) {
  const PosePrior& a = manifest.At(edge.pair.a).prior;
  const PosePrior& b = manifest.At(edge.pair.b).prior;
  const bool has_direction =
      edge.kind == TwoViewKind::kGeneral || edge.kind == TwoViewKind::kPlanar;
  if (!has_direction || !a.position_in_enu || !b.position_in_enu) return std::nullopt;
  const Eigen::Vector3d step_m = *b.position_in_enu - *a.position_in_enu;
  return EdgeStep{.by_gnss_rad = std::atan2(step_m.x(), step_m.y()),
                  .in_a_rad = AzimuthInCamera(edge.b_from_a.Centre()),
                  .in_b_rad = AzimuthInCamera(-edge.b_from_a.translation),
                  .distance_m = DistanceBetween(a, b),
                  .sigma_m = SigmaBetween(a, b)};
}

/// How far the end of a step of this length is from a ray that is so far off its direction.
double MissOf(double distance_m, double angle_rad) {
  return angle_rad < std::numbers::pi / 2.0 ? distance_m * std::sin(angle_rad) : distance_m;
}

}  // namespace

std::vector<MotionEdge> MotionEdgesOf(const std::vector<ViewEdge>& edges,
                                      const ImageManifest& manifest,
                                      const PlacesInDrives& places) {
  std::vector<MotionEdge> motions;
  for (uint32_t e = 0; e < edges.size(); ++e) {
    if (edges[e].kind == TwoViewKind::kNone) continue;
    const auto [a, b] = edges[e].pair;
    motions.push_back({.edge = e,
                       .a = a.value,
                       .b = b.value,
                       .weight = std::sqrt(static_cast<double>(edges[e].num_inliers)),
                       .is_in_sequence = IsInSequence(edges[e].pair, places),
                       .turn_rad = TurnOf(edges[e].b_from_a.rotation),
                       .step = StepOf(edges[e], manifest)});
  }
  return motions;
}

std::optional<StepError> StepErrorOf(const MotionEdge& edge, const Headings& headings) {
  const std::optional<double>& a = headings[edge.a];
  const std::optional<double>& b = headings[edge.b];
  if (!edge.step || !a || !b) return std::nullopt;
  const double angle_rad = std::min(AngleBetweenAzimuths(edge.step->HeadingOfA(), *a),
                                    AngleBetweenAzimuths(edge.step->HeadingOfB(), *b));
  return StepError{angle_rad, MissOf(edge.step->distance_m, angle_rad)};
}

std::optional<double> TurnErrorOf(const MotionEdge& edge, const Headings& headings) {
  const std::optional<double>& a = headings[edge.a];
  const std::optional<double>& b = headings[edge.b];
  if (!a || !b) return std::nullopt;
  return AngleBetweenAzimuths(edge.turn_rad, *a - *b);
}

bool TurnsOtherwise(const MotionEdge& edge, const Headings& headings) {
  const std::optional<double> error_rad = TurnErrorOf(edge, headings);
  return error_rad && *error_rad > kTurnsOtherwise_rad;
}

}  // namespace orbweave
