// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/graph/motion_edge.h"
#include "core/scene/image_manifest.h"
#include "core/scene/places_in_drives.h"

namespace orbweave {

/// Per image: whether its position may speak against an edge.
///
/// A position that is off puts the image elsewhere than all its edges do. Edges are held against
/// positions by their directions and the `headings` (StepErrorOf): one does not fit that misses by
/// more than three standard deviations, and is more than 20 degrees off. Positions go out of which
/// more than a quarter of the edges, by weight, do not fit, or half where the position lies between
/// its neighbours' as a street goes, the worst first, and with each its edges; so do those that are
/// left with fewer than two. Edges between neighbours in the sequence decide, where an image has
/// two of them, as few of those are of places that only look alike. What turns otherwise than the
/// headings (TurnsOtherwise) is no witness.
///
/// Time n log n in edges.
[[nodiscard]] std::vector<uint8_t> TrustedPositions(const std::vector<MotionEdge>& edges,
                                                    const Headings& headings,
                                                    const ImageManifest& manifest,
                                                    const PlacesInDrives& places);

}  // namespace orbweave
