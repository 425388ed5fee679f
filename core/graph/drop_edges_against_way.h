// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/graph/sifted_edges.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// Edges without those between neighbours of a drive that lead back along it. Where windows or
/// houses repeat, most matches of neighbours may join each window with the next: a motion that is
/// consistent, with the right rotation and the wrong direction, which no triangle of rotations
/// tells from the truth, and, where there are more of them than of right ones, no chain of steps
/// either. But a camera that moves along a street goes on as it came.
///
/// What lies ahead in each camera is what most edges between neighbours around agree on, each taken
/// as a step onward (MotionEdgesAlongWay, FindHeadings; three edges around, so that a corner leaves
/// it open rather than wrong). An edge is dropped that is more than 120 degrees off that at both of
/// its images, while two others of each lead onward (60 degrees or less), one from before the two
/// and one beyond them among these: a drive that turns round does not go on. Nothing is said of
/// drives whose order is none: that have no edge between one and the next image in a fifth of the
/// places.
///
/// Time n log n in edges.
[[nodiscard]] SiftedEdges DropEdgesAgainstWay(const std::vector<ViewEdge>& edges,
                                              const ImageManifest& manifest);

}  // namespace orbweave
