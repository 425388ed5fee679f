// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/partitioned_ba/divide_terms.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/partitioned_ba/assign_tracks.h"

namespace orbweave {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

bool IsFixedPoint(const BundleProblem& problem, uint32_t point) {
  return !problem.point_is_fixed.empty() && problem.point_is_fixed[point] != 0;
}

// The free poses that see each point, each once; of points that only held poses see, those.
std::vector<std::vector<uint32_t>> FindObservers(const BundleProblem& problem, const Gauge& gauge) {
  std::vector<std::vector<uint32_t>> observers(problem.points_in_world.size());
  for (const bool is_held : {false, true}) {
    std::vector<uint8_t> is_found(observers.size());
    for (size_t point = 0; point < observers.size(); ++point) {
      is_found[point] = !observers[point].empty();
    }
    for (const BundleObservation& seen : problem.observations) {
      if ((gauge.pose_is_held[seen.pose] != 0) != is_held || is_found[seen.point]) continue;
      observers[seen.point].push_back(seen.pose);
    }
  }
  for (std::vector<uint32_t>& poses : observers) {
    std::sort(poses.begin(), poses.end());
    poses.erase(std::unique(poses.begin(), poses.end()), poses.end());
  }
  return observers;
}

// Per point the subproblem of its observations; kSplitTrack: each goes to the owner of its pose.
std::vector<uint32_t> SubproblemsOfPoints(const BundleProblem& problem,
                                          const Gauge& gauge,
                                          const std::vector<uint32_t>& owner_of_pose) {
  std::vector<std::vector<uint32_t>> observers = FindObservers(problem, gauge);
  std::vector<uint32_t> subproblem_of_point(observers.size(), kSplitTrack);
  std::vector<uint32_t> crossing;
  std::vector<std::vector<uint32_t>> tracks;
  for (uint32_t point = 0; point < observers.size(); ++point) {
    std::vector<uint32_t>& poses = observers[point];
    if (poses.empty() || IsFixedPoint(problem, point)) continue;
    const uint32_t owner = owner_of_pose[poses.front()];
    const bool is_within = std::all_of(
        poses.begin(), poses.end(), [&](uint32_t pose) { return owner_of_pose[pose] == owner; });
    if (is_within) {
      subproblem_of_point[point] = owner;
    } else {
      crossing.push_back(point);
      tracks.push_back(std::move(poses));
    }
  }
  const std::vector<uint32_t> subproblem_of_track = AssignTracks(tracks, owner_of_pose);
  for (size_t i = 0; i < crossing.size(); ++i)
    subproblem_of_point[crossing[i]] = subproblem_of_track[i];
  return subproblem_of_point;
}

}  // namespace

std::vector<SubproblemTerms> DivideTerms(const BundleProblem& problem,
                                         const Gauge& gauge,
                                         const std::vector<uint32_t>& owner_of_pose,
                                         uint32_t num_subproblems) {
  std::vector<SubproblemTerms> terms(num_subproblems);
  const std::vector<uint32_t> subproblem_of_point =
      SubproblemsOfPoints(problem, gauge, owner_of_pose);
  for (uint32_t i = 0; i < problem.observations.size(); ++i) {
    const BundleObservation& seen = problem.observations[i];
    const uint32_t subproblem = subproblem_of_point[seen.point];
    terms[subproblem == kSplitTrack ? owner_of_pose[seen.pose] : subproblem].observations.push_back(
        i);
  }
  std::vector<uint32_t> subproblem_of_bias(problem.bias_sigma_m.size(), kNone);
  for (uint32_t i = 0; i < problem.position_priors.size(); ++i) {
    const PositionPrior& prior = problem.position_priors[i];
    const uint32_t subproblem = owner_of_pose[prior.pose];
    terms[subproblem].position_priors.push_back(i);
    if (!prior.bias_group) continue;
    subproblem_of_bias[*prior.bias_group] =
        std::min(subproblem_of_bias[*prior.bias_group], subproblem);
  }
  for (uint32_t i = 0; i < problem.direction_priors.size(); ++i) {
    terms[owner_of_pose[problem.direction_priors[i].pose]].direction_priors.push_back(i);
  }
  for (uint32_t group = 0; group < subproblem_of_bias.size(); ++group) {
    const uint32_t subproblem = subproblem_of_bias[group];
    terms[subproblem == kNone ? 0 : subproblem].bias_priors.push_back(group);
  }
  return terms;
}

}  // namespace orbweave
