// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/graph/sifted_edges.h"
#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// Edges without those that lead elsewhere than GNSS, or turn otherwise. Houses that look alike,
/// and windows that repeat, make pairs that are consistent in themselves; where cameras are headed
/// (FindHeadings) shows that they are of another place.
///
/// An edge whose positions are trusted (TrustedPositions) is dropped when it misses both
/// (StepError) by more than three standard deviations and 15 m, which positions of a street may be
/// off together whatever they say; or when they are 2.5 standard deviations apart and it leads the
/// other way, by more than 90 degrees at either image. So is one that turns otherwise than the
/// headings, where most edges of both images do not.
///
/// Headings are taken twice, the second time without the positions that are not trusted. Time
/// n log n in edges.
[[nodiscard]] SiftedEdges DropEdgesAgainstHeadings(const std::vector<ViewEdge>& edges,
                                                   const ImageManifest& manifest);

}  // namespace orbweave
