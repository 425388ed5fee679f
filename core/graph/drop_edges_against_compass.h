// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/graph/sifted_edges.h"
#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// Edges without those that turn otherwise than the headings that are stated of their images: a
/// house that repeats round a corner has a geometry of its own, a quarter turn off, and many
/// matches. Cameras are upright to some degrees.
///
/// An edge disagrees when the turn between its cameras differs from that of their headings by more
/// than four standard deviations, 20 degrees at least and 90 at most. Headings may be wrong, or
/// those of the way and not of the camera: between two drives, or within one, they are believed
/// when there are ten edges with headings or more, of which three quarters agree. A compass beside
/// iron is off by itself: where all edges of an image, three at least, turn otherwise by the same
/// angle to 20 degrees, and lead to images some of whose edges agree, its heading is not believed;
/// unless that is a quarter turn or a half, to 20 degrees, as what repeats round corners has. Edges
/// without headings stay.
[[nodiscard]] SiftedEdges DropEdgesAgainstCompass(const std::vector<ViewEdge>& edges,
                                                  const ImageManifest& manifest);

}  // namespace orbweave
