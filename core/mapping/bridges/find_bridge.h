// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/geometry/sim3.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// The similarity that joins submodel b to submodel a of the same cluster where too few scene
/// points are seen from both for their images to be registered with each other: from the relative
/// rotations and directions of the verified pairs between them, the points of each that those pairs
/// say the other sees, and GNSS (FitBridge). Steps of ten metres between plain walls leave hardly a
/// point that three panoramas see, and with it the scale open from one step to the next.
///
/// nullopt unless all of this holds:
///   - pairs with half of the matches agree in rotation and in direction, with 2 min_inliers
///     matches at least;
///   - half of the points agree that those pairs say the other sees; or, whatever points say, two
///     pairs hold b at both of its ends, where GNSS places a: a side of a block whose corners are
///     seen from around them has hardly a point in common with either street, and where houses
///     repeat most that it seems to have are wrong, but a house that looks like another does so at
///     one end;
///   - the scale of b is known to a fifth (for one camera: its place to half of the shortest
///     baseline);
///   - near the pairs (ImagesNear) seven tenths of b's GNSS positions lie within three sigmas of
///     where they come to be; or, where GNSS does not place a, three pairs agree that have two
///     images or more on each side. A pair that is wrong as a whole, a house that looks like
///     another, agrees with neither.
[[nodiscard]] std::optional<Sim3> FindBridge(const MappingState& a,
                                             const MappingState& b,
                                             const MappingOptions& options);

}  // namespace orbweave
