// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// A submodel in pieces where it hangs together by fewer telling points than an image needs to be
/// registered (min_inliers), and GNSS has what hangs there elsewhere: a street that a wrong pair
/// led into at a crossing, and that then went on by itself, on another scale or another way. Of
/// its steps each is as GNSS of some metres has them; all of them together are not. Points that
/// three images see are telling: two alone say which way one lies from the other, not how far, so
/// that what hangs at them has any size (HingeFinder).
///
/// Images hold together by pairs with so many common telling points; what does so is in one piece.
/// The smaller side of a weak joint is cut off when
///   - no more such points are seen from both sides together,
///   - its positions agree with it as it is by itself (PlaceOnGnss), and
///   - less than seven tenths of them lie where the images of the other side near the joint
///     (ImagesNear) have them, within three sigmas, as bridges ask (FindBridge), or a fifth of the
///     way from the joint: what is bent by some degrees is worth more in one piece.
/// Bridges may join the pieces again, as GNSS has them; else each is a submodel of its own. The
/// larger piece first; one piece, the submodel as it is, where nothing is cut.
[[nodiscard]] std::vector<MappingState> CutAtHinges(MappingState submodel,
                                                    const MappingOptions& options);

}  // namespace orbweave
