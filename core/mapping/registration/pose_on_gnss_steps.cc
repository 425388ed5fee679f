// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/pose_on_gnss_steps.h"

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/rotation.h"
#include "core/geometry/sphere_cells.h"
#include "core/mapping/registration/pose_from_pairs.h"
#include "core/mapping/registration/pose_of_most_places.h"

namespace orbweave {
namespace {

constexpr size_t kFewestVotes = 4;
constexpr size_t kVotesForOne = 3;      // one of so many
constexpr double kClearlyNearer = 1.0;  // sigmas

/// Points that agree, by place.
using PlaceCounts = std::array<uint32_t, static_cast<size_t>(kSpreadCells) * kSpreadCells>;

PlaceCounts CountByPlace(const Rigid3& pose,
                         const SceneCorrespondences& correspondences,
                         double max_error_rad) {
  PlaceCounts counts{};
  for (size_t i = 0; i < correspondences.size(); ++i) {
    const Eigen::Vector3d& bearing = correspondences.bearings[i];
    if (IsWithinAngle(pose * correspondences.positions[i], bearing, max_error_rad))
      ++counts[SphereCell(bearing, kSpreadCells)];
  }
  return counts;
}

bool DoPlacesVoteFor(const Rigid3& other,
                     const Rigid3& found,
                     const SceneCorrespondences& correspondences,
                     double max_error_rad) {
  const PlaceCounts at_other = CountByPlace(other, correspondences, max_error_rad);
  const PlaceCounts at_found = CountByPlace(found, correspondences, max_error_rad);
  size_t votes = 0;
  size_t votes_for_other = 0;
  for (size_t i = 0; i < at_other.size(); ++i) {
    votes += at_other[i] != at_found[i] ? 1U : 0U;
    votes_for_other += at_other[i] > at_found[i] ? 1U : 0U;
  }
  return votes_for_other >= kFewestVotes && kVotesForOne * votes_for_other >= votes;
}

}  // namespace

std::optional<Rigid3> PoseOnGnssSteps(const MappingState& state,
                                      ImageSlot image,
                                      const StepWitness& gnss,
                                      const Rigid3& found,
                                      const SceneCorrespondences& correspondences,
                                      double max_error_rad) {
  if (!gnss.Contradicts(found.Centre())) return std::nullopt;
  std::vector<Rigid3> candidates;
  for (const Rigid3& pose : PosesOfPairs(state, image, correspondences)) {
    if (gnss.Supports(pose.Centre())) candidates.push_back(pose);
  }
  const std::optional<Rigid3> best =
      CandidateOfMostPlaces(candidates, correspondences, max_error_rad);
  if (!best || *gnss.Misfit(best->Centre()) > *gnss.Misfit(found.Centre()) - kClearlyNearer ||
      !DoPlacesVoteFor(*best, found, correspondences, max_error_rad)) {
    return std::nullopt;
  }
  return best;
}

}  // namespace orbweave
