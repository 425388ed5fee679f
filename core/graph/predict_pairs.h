// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/scene/pair_candidates.h"

namespace orbweave {

/// Of the pairs `tried`, those that are not among the verified pairs `matched` and that two of
/// these join, a-m and m-b: with what they predict of a-b. What many wrong matches hide from
/// samples of five, samples of two find when the rotation is known. Both have a baseline and more
/// evidence than places that look alike have, and the way over m turns by 60 degrees at most: else
/// it says too little of where b lies. Of several such images m one is taken with whose rotation
/// most others agree, of these the one whose weaker pair has most evidence.
///
/// In order of the pairs; each once. `tried` and `matched` in any order.
[[nodiscard]] std::vector<PredictedPair> PredictPairs(std::span<const ImagePair> tried,
                                                      std::span<const MatchedPair> matched,
                                                      size_t num_images);

}  // namespace orbweave
