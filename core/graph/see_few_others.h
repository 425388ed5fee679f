// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "core/scene/pair_candidates.h"

namespace orbweave {

/// Whether panoramas are too far apart for their own features: more than half of `num_images` have
/// fewer than three others, or than all with which they were `tried`, that `matched` shows beyond
/// doubt (IsBeyondDoubt). A drive whose panoramas see the next but one has four of these each, one
/// where they see the next alone has two. Of rendered streets with a panorama every 2, 5, 8, 10 and
/// 12 m none, a tenth, about half, five sixths and nine tenths had fewer than three.
[[nodiscard]] bool SeeFewOthers(size_t num_images,
                                std::span<const ImagePair> tried,
                                std::span<const MatchedPair> matched);

}  // namespace orbweave
