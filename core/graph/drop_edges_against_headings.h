// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/graph/drop_edges_against_gnss.h"
#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// Edges without those that lead the other way than GNSS. Where windows or houses repeat, most
/// matches of neighbours may join each window with the next: a motion that is consistent, with the
/// right rotation and the wrong direction, and that no triangle of rotations tells from the truth.
///
/// An edge of two images 2.5 standard deviations apart by GNSS says how either camera is headed:
/// azimuth of the step by GNSS less azimuth of the step in the camera, which stands upright to some
/// degrees. Headings go over to neighbours by the rotation of edges. An image has a heading where
/// more than half of all that it is told lie within 45 degrees of one, and three at least; its
/// position is trusted when more of its edges agree to 45 degrees with the headings at their other
/// ends than do not: one that is off turns all of them. An edge of trusted images is dropped that
/// is more than 90 degrees off the headings of both.
///
/// Time linear in edges times the edges of an image.
[[nodiscard]] EdgesByGnss DropEdgesAgainstHeadings(const std::vector<ViewEdge>& edges,
                                                   const ImageManifest& manifest);

}  // namespace orbweave
