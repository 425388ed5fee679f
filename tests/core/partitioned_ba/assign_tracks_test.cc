// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/assign_tracks.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

using Tracks = std::vector<std::vector<uint32_t>>;

TEST(AssignTracks, MakesSeparatorsOfTheSideWithFewerPanoramas) {
  // Poses 0-2 belong to subproblem 0, poses 3-4 to subproblem 1; everything is seen by all.
  const std::vector<uint32_t> owners = {0, 0, 0, 1, 1};
  const Tracks tracks(10, {0, 1, 2, 3, 4});
  // 3 and 4 become separators: the tracks are subproblem 0's.
  EXPECT_EQ(AssignTracks(tracks, owners), std::vector<uint32_t>(10, 0));
}

TEST(AssignTracks, PrefersTheSmallerSubproblemAsSeparatorsWhenEqual) {
  EXPECT_EQ(AssignTracks(Tracks(10, {0, 1}), {0, 1}), std::vector<uint32_t>(10, 1));
  EXPECT_EQ(AssignTracks(Tracks(10, {0, 1}), {1, 0}), std::vector<uint32_t>(10, 1));
}

TEST(AssignTracks, SplitsAFewTracksInsteadOfAddingPanoramas) {
  const std::vector<uint32_t> owners = {0, 0, 1, 1};
  Tracks tracks(10, {1, 2});
  tracks.push_back({0, 3});  // the only track of 0 and of 3 that crosses
  std::vector<uint32_t> expected(10, 1);
  expected.push_back(kSplitTrack);
  EXPECT_EQ(AssignTracks(tracks, owners), expected);
}

TEST(AssignTracks, GivesTracksBetweenSeparatorsToTheOwnerOfMost) {
  // Subproblem 1's panoramas 2 and 3 are cut off from subproblem 0, and from subproblem 2, which
  // has more there.
  const std::vector<uint32_t> owners = {0, 0, 0, 1, 1, 2, 2, 2};
  Tracks tracks(10, {0, 1, 2, 3, 4});
  tracks.insert(tracks.end(), 10, {3, 4, 5, 6, 7});
  tracks.push_back({3, 4});
  const std::vector<uint32_t> subproblems = AssignTracks(tracks, owners);
  EXPECT_EQ(subproblems.front(), 0U);
  EXPECT_EQ(subproblems[10], 2U);
  EXPECT_EQ(subproblems.back(), 1U);
}

}  // namespace
}  // namespace orbweave
