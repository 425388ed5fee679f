// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/graph/pair_options.h"
#include "core/scene/image_manifest.h"
#include "core/scene/pair_candidates.h"

namespace orbweave {

/// What to match next, decided by what was found; `matched` are all verified pairs so far, in any
/// order, and `before` is what was decided with fewer of them.
///
/// First about the second candidates. One is held back where its images follow one another in
/// their drive (pairs.sequence_window), are joined by a chain of at most four pairs that are strong
/// (evidence beyond doubt, and many matches that show where the camera went), and by two pairs that
/// are either strong or, shorter ones before longer ones, of the candidates that are not held back:
/// of far pairs along a strong chain a spanner of stretch 2 stays. All others are matched.
///
/// Then, with these matched, about images with fewer than pairs.thin_below verified pairs, and
/// those of small parts that verified pairs hold together: what was held back of theirs is matched
/// after all, and the reserve.
///
/// At last about pairs that were matched and not verified, where others predict how their cameras
/// are turned (PredictPairs, pairs.predict): they are matched again.
///
/// All look at what is found alone, so equal findings give equal decisions. Memory is
/// linear in the candidates, time but for sorting them and the pairs of pairs of an image.
[[nodiscard]] WiderPairs ChooseWiderPairs(const ImageManifest& manifest,
                                          const PairCandidates& candidates,
                                          std::span<const MatchedPair> matched,
                                          const WiderPairs& before,
                                          const PairOptions& options);

}  // namespace orbweave
