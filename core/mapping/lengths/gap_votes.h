// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/mapping/lengths/asked_rays.h"
#include "core/mapping/lengths/ways_along_lines.h"

namespace orbweave {

/// How long a pair that leads across a way is, as one ray has it.
struct LengthVote {
  uint32_t pair = 0;  ///< of those asked
  double log_length = 0.0;
  Node ray = 0;
};

/// A way along a line, and how long the pairs that lead across it are as each side of it has it.
struct GapVotes : WayAlongLine {
  std::vector<LengthVote> before{};  ///< of rays of images before it
  std::vector<LengthVote> behind{};
  uint32_t asked = 0;  ///< rays of all pairs across, whether others tell how long these are or not
};

/// Votes across each way from a registered image of a line (FindStreetLines) to the next. Where a
/// street is torn, everything behind the tear stands a house, or half of one, too far along: pairs
/// that lead across are all too long, bear each other out, and outnumber those beside it. Therefore
/// a ray tells the length of a pair that leads across by those of its pairs alone that stay on its
/// own image's side, the median of them, which a tear leaves as they are.
///
/// Pairs and votes may be none. Of lines in order, of images along them (RegisteredSequence); votes
/// in order of rays.
[[nodiscard]] std::vector<GapVotes> CollectGapVotes(const AskedRays& asked);

}  // namespace orbweave
