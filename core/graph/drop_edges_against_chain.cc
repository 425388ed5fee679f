// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "core/geometry/rotation.h"
#include "core/graph/drive_chain.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
// The logarithm of the depth wanders by this much a step: matched points of streets lie between 5
// and 30 m, and that changes from block to block, not from panorama to panorama.
constexpr double kDepthWander = 0.1;
// Drift of directions, radians: ten times that of rotations, for steps of little parallax.
constexpr double kDrift_rad = 0.1;
// The points of a pair may be so much deeper than those of neighbours around.
constexpr double kDeeper = 2.0;
// Depths that a pair is off where nothing is wrong: panoramas that turn on the spot.
constexpr double kSlack = 0.3;
constexpr double kTurn_deg = 15.0;
constexpr double kTurnPerRootStep_deg = 0.5;
constexpr double kNearSigmas = 3.0;

bool IsNearByGnss(const ImagePair& pair, const ImageManifest& manifest) {
  const PosePrior& a = manifest.At(pair.a).prior;
  const PosePrior& b = manifest.At(pair.b).prior;
  if (!a.position_in_enu || !b.position_in_enu) return false;
  return DistanceBetween(a, b) <= kNearSigmas * SigmaBetween(a, b);
}

// By how many depths the drive misses the edge at least, for the direction that shows it best.
double Miss(const DriveChain::Way& way,
            const Rigid3& last_from_first,
            double length,
            bool may_see_far) {
  const double f = std::exp(kDepthWander * (1.0 + std::sqrt(static_cast<double>(way.steps))));
  const Eigen::Vector3d direction =
      length > 0.0 ? Eigen::Vector3d(way.stretch_from_first * last_from_first.Centre().normalized())
                   : Eigen::Vector3d::Zero();
  const double longest = may_see_far ? std::numeric_limits<double>::infinity() : kDeeper * length;
  double miss = 0.0;
  for (size_t axis = 0; axis < DriveChain::kAxes; ++axis) {
    for (const double side : {1.0, -1.0}) {
      const double ahead = side > 0.0 ? way.forward[axis] : way.backward[axis];
      const double back = side > 0.0 ? way.backward[axis] : way.forward[axis];
      const double along = side * DriveChain::Axes()[axis].dot(direction);
      const double reached = along > 0.0 ? longest * along : 0.0;
      miss = std::max(miss, ahead / f - back * f - kDrift_rad * way.length - reached);
    }
  }
  return miss;
}

// Why the drive rules the edge out; empty where it does not.
std::string FindFault(const DriveChain& chain, const ViewEdge& edge) {
  const std::optional<DriveChain::Way> way = chain.Between(edge.pair.a, edge.pair.b);
  if (!way || way->steps < 2) return "";
  const Rigid3 last_from_first =
      way->first == edge.pair.a ? edge.b_from_a : edge.b_from_a.Inverse();
  const double turn_deg =
      kDegPerRad * RotationAngle(last_from_first.rotation * way->last_from_first.conjugate());
  if (turn_deg > kTurn_deg + kTurnPerRootStep_deg * std::sqrt(static_cast<double>(way->steps)))
    return "turns by " + std::to_string(std::lround(turn_deg)) + " degrees against the " +
           std::to_string(way->steps) + " steps of the drive between its images";
  if (Miss(*way, last_from_first, BaselineOverDepth(edge), chain.MaySeeFar(edge)) <= kSlack)
    return "";
  return "the " + std::to_string(way->steps) +
         " steps of the drive between its images do not end where it says";
}

}  // namespace

SiftedEdges DropEdgesAgainstChain(const std::vector<ViewEdge>& edges,
                                  const ImageManifest& manifest) {
  const DriveChain chain(edges, manifest);
  return SiftEdges(edges, DropCause::kSequence, [&](uint32_t e) -> std::string {
    const ViewEdge& edge = edges[e];
    if (edge.kind == TwoViewKind::kNone || IsNearByGnss(edge.pair, manifest)) return "";
    return FindFault(chain, edge);
  });
}

}  // namespace orbweave
