// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/assign_tracks.h"

#include <algorithm>
#include <map>
#include <utility>

namespace orbweave {
namespace {

constexpr uint32_t kFewTracks = 2;

// Two subproblems, a < b, and the tracks that panoramas of both see.
using SubproblemPair = std::pair<uint32_t, uint32_t>;
using TracksOfPair = std::map<SubproblemPair, std::vector<uint32_t>>;

std::vector<uint32_t> OwnersOf(const std::vector<uint32_t>& poses,
                               const std::vector<uint32_t>& owner_of_pose) {
  std::vector<uint32_t> owners;
  for (const uint32_t pose : poses) owners.push_back(owner_of_pose[pose]);
  std::sort(owners.begin(), owners.end());
  owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
  return owners;
}

TracksOfPair FindCrossingTracks(const std::vector<std::vector<uint32_t>>& tracks,
                                const std::vector<uint32_t>& owner_of_pose) {
  TracksOfPair crossing;
  for (uint32_t track = 0; track < tracks.size(); ++track) {
    const std::vector<uint32_t> owners = OwnersOf(tracks[track], owner_of_pose);
    for (size_t j = 1; j < owners.size(); ++j) {
      for (size_t i = 0; i < j; ++i) crossing[{owners[i], owners[j]}].push_back(track);
    }
  }
  return crossing;
}

// What it takes to cut the tracks between two subproblems on one side.
struct Side {
  std::vector<uint32_t> separators{};  ///< poses
  size_t num_variables = 0;            ///< with those of the tracks that are split
};

Side CutOn(uint32_t subproblem,
           const std::vector<uint32_t>& crossing,
           const std::vector<std::vector<uint32_t>>& tracks,
           const std::vector<uint32_t>& owner_of_pose) {
  std::map<uint32_t, uint32_t> num_tracks;  // of the subproblem's poses
  const auto for_each_pose = [&](uint32_t track, const auto& visit) {
    for (const uint32_t pose : tracks[track]) {
      if (owner_of_pose[pose] == subproblem) visit(pose);
    }
  };
  for (const uint32_t track : crossing) {
    for_each_pose(track, [&](uint32_t pose) { ++num_tracks[pose]; });
  }
  Side side;
  for (const auto& [pose, count] : num_tracks) {
    if (count > kFewTracks) side.separators.push_back(pose);
  }
  size_t num_split = 0;
  for (const uint32_t track : crossing) {
    bool is_split = false;
    for_each_pose(track, [&](uint32_t pose) { is_split |= num_tracks[pose] <= kFewTracks; });
    if (is_split) ++num_split;
  }
  side.num_variables = 6 * side.separators.size() + 3 * num_split;
  return side;
}

std::vector<uint8_t> ChooseSeparators(const std::vector<std::vector<uint32_t>>& tracks,
                                      const std::vector<uint32_t>& owner_of_pose) {
  std::vector<uint8_t> is_separator(owner_of_pose.size(), 0);
  for (const auto& [subproblems, crossing] : FindCrossingTracks(tracks, owner_of_pose)) {
    const Side a = CutOn(subproblems.first, crossing, tracks, owner_of_pose);
    const Side b = CutOn(subproblems.second, crossing, tracks, owner_of_pose);
    const Side& side = b.num_variables < a.num_variables ? b : a;
    for (const uint32_t pose : side.separators) is_separator[pose] = 1;
  }
  return is_separator;
}

// The owner of most of the poses, the smallest of equals.
uint32_t MainOwner(const std::vector<uint32_t>& poses, const std::vector<uint32_t>& owner_of_pose) {
  std::map<uint32_t, uint32_t> num_poses;
  for (const uint32_t pose : poses) ++num_poses[owner_of_pose[pose]];
  return std::max_element(num_poses.begin(),
                          num_poses.end(),
                          [](const auto& x, const auto& y) { return x.second < y.second; })
      ->first;
}

}  // namespace

std::vector<uint32_t> AssignTracks(const std::vector<std::vector<uint32_t>>& tracks,
                                   const std::vector<uint32_t>& owner_of_pose) {
  const std::vector<uint8_t> is_separator = ChooseSeparators(tracks, owner_of_pose);
  std::vector<uint32_t> subproblem_of_track;
  std::vector<uint32_t> interior;
  for (const std::vector<uint32_t>& poses : tracks) {
    interior.clear();
    for (const uint32_t pose : poses) {
      if (!is_separator[pose]) interior.push_back(pose);
    }
    const std::vector<uint32_t> owners = OwnersOf(interior, owner_of_pose);
    if (owners.empty()) {
      subproblem_of_track.push_back(MainOwner(poses, owner_of_pose));
    } else {
      subproblem_of_track.push_back(owners.size() == 1 ? owners.front() : kSplitTrack);
    }
  }
  return subproblem_of_track;
}

}  // namespace orbweave
