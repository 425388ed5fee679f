// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace orbweave {

/// "No subproblem": the observations of such a track stay with the owners of their panoramas, and
/// its point is a separator.
inline constexpr uint32_t kSplitTrack = std::numeric_limits<uint32_t>::max();

/// Which subproblem eliminates each track that panoramas of several owners see. `tracks`: the
/// (free) poses that see it, each once, at least one. Per pair of subproblems the panoramas of one
/// side that look across become separators and the tracks go to the other side; a panorama that
/// shares at most two tracks with the other side stays interior, and those tracks are split, since
/// a separator point has three variables, a separator panorama six. The side with fewer variables
/// is taken, that of the smaller subproblem when equal. Afterwards no unsplit track touches the
/// interiors of two subproblems.
[[nodiscard]] std::vector<uint32_t> AssignTracks(const std::vector<std::vector<uint32_t>>& tracks,
                                                 const std::vector<uint32_t>& owner_of_pose);

}  // namespace orbweave
