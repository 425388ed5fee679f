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

MotionEdge MotionOf(const std::vector<ViewEdge>& edges, uint32_t e, const PlacesInDrives& places) {
  return {.edge = e,
          .a = edges[e].pair.a.value,
          .b = edges[e].pair.b.value,
          .weight = std::sqrt(static_cast<double>(edges[e].num_inliers)),
          .is_in_sequence = IsInSequence(edges[e].pair, places),
          .turn_rad = TurnOf(edges[e].b_from_a.rotation)};
}

EdgeStep StepTo(double azimuth_rad, const ViewEdge& edge) {
  return {.azimuth_rad = azimuth_rad,
          .in_a_rad = AzimuthInCamera(edge.b_from_a.Centre()),
          .in_b_rad = AzimuthInCamera(-edge.b_from_a.translation)};
}

std::optional<EdgeStep> StepByGnss(const ViewEdge& edge, const ImageManifest& manifest) {
  const PosePrior& a = manifest.At(edge.pair.a).prior;
  const PosePrior& b = manifest.At(edge.pair.b).prior;
  if (!HasBaseline(edge.kind) || !a.position_in_enu || !b.position_in_enu) return std::nullopt;
  const Eigen::Vector3d step_m = *b.position_in_enu - *a.position_in_enu;
  EdgeStep step = StepTo(std::atan2(step_m.x(), step_m.y()), edge);
  step.distance_m = DistanceBetween(a, b);
  step.sigma_m = SigmaBetween(a, b);
  return step;
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
    motions.push_back(MotionOf(edges, e, places));
    motions.back().step = StepByGnss(edges[e], manifest);
  }
  return motions;
}

std::vector<MotionEdge> MotionEdgesAlongWay(const std::vector<ViewEdge>& edges,
                                            const PlacesInDrives& places) {
  std::vector<MotionEdge> motions;
  for (uint32_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges[e].pair;
    if (!HasBaseline(edges[e].kind) || !IsInSequence(edges[e].pair, places)) continue;
    const bool is_onward = places.PlaceOf(a) < places.PlaceOf(b);
    motions.push_back(MotionOf(edges, e, places));
    motions.back().step = StepTo(is_onward ? 0.0 : std::numbers::pi, edges[e]);
    motions.back().step->distance_m = 1.0;
  }
  return motions;
}

std::optional<StepError> StepErrorOf(const MotionEdge& edge, const Headings& headings) {
  const std::optional<double>& a = headings[edge.a];
  const std::optional<double>& b = headings[edge.b];
  if (!edge.step || !a || !b) return std::nullopt;
  StepError error{.at_a_rad = AngleBetweenAzimuths(edge.step->HeadingOfA(), *a),
                  .at_b_rad = AngleBetweenAzimuths(edge.step->HeadingOfB(), *b)};
  error.miss_m = MissOf(edge.step->distance_m, error.Least());
  return error;
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
