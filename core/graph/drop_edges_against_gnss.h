// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/graph/sifted_edges.h"
#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// Edges without those that join places that look alike though GNSS knows them apart.
///
/// Rays that meet under an angle alpha (median of the edge) start from a baseline of 2 d tan(alpha
/// / 2), where d is the depth of the scene: the median over edges of neighbours in the
/// sequence (of all, where these are few) whose positions are further apart than GNSS errs. An edge
/// disagrees when its positions are more than 8 standard deviations plus 2.5 such baselines apart
/// (5 and 2.5 where positions of both images agree with all their neighbours in the sequence); it
/// agrees within 3 and 1.5. Positions may be wrong, so that an edge is dropped only when at both of
/// its images GNSS disagrees with half or less of the edges to neighbours in the sequence
/// (IsInSequence; where there are less than two of all edges), and edges that agree join
/// its images - or nothing but it, and at most one more panorama on either side, joins two parts
/// of five images and more that agree by themselves. Positions that are smooth along the sequence
/// are thus believed whatever the number of look-alikes; a single position that is off is not, and
/// a stretch of positions that jumped together, which agrees with nothing that joins it to the
/// rest, loses no edge. Edges without geometry and of images without a position stay.
[[nodiscard]] SiftedEdges DropEdgesAgainstGnss(const std::vector<ViewEdge>& edges,
                                               const ImageManifest& manifest);

}  // namespace orbweave
