// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/merging/checks/seen_between.h"
#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// "missed_points": whether panoramas see what others see from either side of them (SeenBetween):
/// one that stands where its own points put it, but not where it was, has few in common with those
/// it stands between. Doubtful where one of `images` sees less than an eighth of the share that is
/// usual in the model, their median, or less than 3 % of what it is asked for. Those that are asked
/// for fewer than 50 points do not count. In rendered streets 8 and 12 m apart that were right the
/// worst saw a third of what is usual; in ones that were wrong by 9 m a twentieth; two of 226 of a
/// town, of which other checks had said nothing, none and a sixteenth. Usual is 0.3 to 0.75.
///
/// Value: the smallest share. `counts`: of all subproblems of a world, in any order.
[[nodiscard]] CrossCheck CheckMissedPoints(const std::vector<SeenBetween>& counts,
                                           const std::map<ImageId, RegisteredImage>& images,
                                           const ImageManifest& manifest);

/// Those of `images` that it doubts, sorted.
[[nodiscard]] std::vector<SeenBetween> ImagesThatMissPoints(
    const std::vector<SeenBetween>& counts, const std::map<ImageId, RegisteredImage>& images);

}  // namespace orbweave
