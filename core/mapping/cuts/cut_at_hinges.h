// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// A submodel in pieces where it hangs together by too little. Each may be right by itself; what
/// is wrong between them no residual shows. In this order, and again until nothing is cut:
///
/// Parts that stand askew to each other, as the matches of the pairs between them have it
/// (PartsThatPairsHold), unless GNSS has them as they are: seven tenths of their positions lie
/// there. 21 panoramas of a town, 0.3 m off in the median, hung together by a pair that contradicts
/// them.
///
/// What GNSS has elsewhere: a street that a wrong pair led into at a crossing, and that then went
/// on by itself, on another scale or another way. Of its steps each is as GNSS of some metres has
/// them; all of them together are not. Points that three images see are telling: two alone say
/// which way one lies from the other, not how far. Images hold together by pairs with min_inliers
/// common telling points; the smaller side of a weaker joint is cut off when
///   - no more such points are seen from both sides together,
///   - its positions agree with it as it is by itself (PlaceOnGnss), and
///   - less than seven tenths of them lie where the images of the other side near the joint
///     (ImagesNear) have them, within three sigmas, as bridges ask (FindBridge), or a fifth of the
///     way from the joint: what is bent by some degrees is worth more in one piece.
///
/// What nothing tells the size of: parts of a scale of their own (PartsOfOneScale), unless GNSS has
/// them as they are. 88 panoramas of a town without GNSS
/// were parts of 55, 20 and 10, each right by itself, on scales of 13, 42 and 18 to 1.
///
/// Bridges may join the pieces again, as pairs or GNSS have it; else each is a submodel of its own.
/// The larger piece first; one piece, the submodel as it is, where nothing is cut.
[[nodiscard]] std::vector<MappingState> CutAtHinges(MappingState submodel,
                                                    const MappingOptions& options);

}  // namespace orbweave
