// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// The registered images in parts that verified pairs hold together. Between two of them fewer than
/// a third of the matches lie where the model has the two stand and turn to each other (IsAskew),
/// or every pair contradicts the model (JudgePairs) and leads elsewhere or turns otherwise, by
/// 20 degrees or more: of 1,267 matches round a corner half agreed with a model that had the second
/// image 80 degrees beside where it is, as they lay on the horizon. Each part may be right by
/// itself; what put the one beside the other are a few points that outvoted pairs: 8 of the 400
/// matches of a neighbour agreed in a street that was wrong from there on, 3 of 329 in another.
///
/// A line (FindStreetLines) holds together but at ways across which pairs do not. What is left of
/// lines is held together by pairs of two of them, where half of the matches of one agree,
/// min_inliers at least, or it is not general and tells nothing; and by all pairs between two
/// together that hold. A street round a block holds together at both ends; a house further along
/// that looks like the one here gives a pair that a torn street may have followed, and is outvoted
/// by those beside it. But where every pair across a way of a line leads elsewhere, its sides stay
/// apart whatever holds them at another place: 26 pairs of houses that were alike on two sides of a
/// block outvoted the two right ones at its corners, and a street that had lost its scale at one
/// corner closed round the block all the same. What no pair joins to any other part stays with the
/// largest.
///
/// The part of most images first, of equal ones that of the lowest; images ascending.
[[nodiscard]] std::vector<std::vector<ImageSlot>> PartsThatPairsHold(const MappingState& state,
                                                                     const MappingOptions& options);

}  // namespace orbweave
