// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/find_wall_shift.h"

#include <cmath>
#include <complex>

#include "core/mapping/lengths/find_length_faults.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kFarthestShare = 0.35;

Vector3d RayInWorld(const MappingState& state, Node node) {
  const CorrespondenceGraph& graph = state.Graph();
  return state.CamFromWorld(graph.image_of_node[node]).rotation.conjugate() *
         graph.bearing_of_node[node];
}

}  // namespace

std::array<std::vector<LengthVote>, 2> SplitByWalls(const MappingState& state,
                                                    const GapVotes& gap,
                                                    std::span<const LengthVote> votes) {
  const Vector3d way = (state.Centre(gap.next) - state.Centre(gap.image)).normalized();
  const Vector3d across = way.unitOrthogonal();
  const Vector3d third = way.cross(across);
  std::vector<std::complex<double>> rays;  // across the way
  rays.reserve(votes.size());
  std::complex<double> sum;
  for (const LengthVote& vote : votes) {
    const Vector3d ray = RayInWorld(state, vote.ray);
    const std::complex<double> z(ray.dot(across), ray.dot(third));
    rays.push_back(z);
    if (const double squared = std::norm(z); squared > 0.0) sum += z * z / squared;
  }
  const std::complex<double> axis = std::polar(1.0, 0.5 * std::arg(sum));
  std::array<std::vector<LengthVote>, 2> walls;
  for (size_t i = 0; i < votes.size(); ++i)
    walls[std::real(rays[i] * std::conj(axis)) > 0.0 ? 0 : 1].push_back(votes[i]);
  return walls;
}

GapShift FindWallShift(const AskedRays& asked, const GapVotes& gap) {
  std::vector<LengthVote> votes = gap.before;
  votes.insert(votes.end(), gap.behind.begin(), gap.behind.end());
  const double length = (asked.state.Centre(gap.next) - asked.state.Centre(gap.image)).norm();
  const double farthest = kFarthestShare * length;
  GapShift clearest;
  for (const std::vector<LengthVote>& wall : SplitByWalls(asked.state, gap, votes)) {
    if (!TellEnough(wall)) continue;
    const GapShift shift =
        FindGapShiftWithin(asked, gap, wall, -farthest, farthest, kDeviationsOfWall);
    if (IsToldByWall(shift.here, shift.elsewhere) &&
        DeviationsElsewhere(shift.here, shift.elsewhere) >
            DeviationsElsewhere(clearest.here, clearest.elsewhere))
      clearest = shift;
  }
  return clearest;
}

}  // namespace orbweave
