// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// Gives a position to images of which GNSS says nothing, in the middle of a street that is known:
/// their rows of a table were lost, or a receiver found no satellites. Names tell between which
/// others they were taken, and verified pairs that they were taken there. Without it whatever looks
/// like them anywhere joins them to it, as no position speaks against that.
///
/// Runs of such images, one after the other by id within a folder, each joined by an edge to the
/// next or the next but one, and so to one with a position before the run or behind it. The k-th of
/// n - 1 images between two that are d apart, with captures s apart as is usual in the folder
/// (UsualStep, CapturesAlong), is put at k / n of the way; steps that are uneven leave a bridge,
/// and a way of n s that is longer than d an ellipse about both, so that
///   sigma^2 = max(sigma_a, sigma_b)^2 + s^2 k (n - k) / n + |(n s)^2 - d^2| / 4.
/// Beside one alone it is put there, with sigma^2 = sigma_a^2 + (k s)^2. In height likewise.
void PlaceByName(const std::vector<ViewEdge>& edges, ImageManifest& manifest);

}  // namespace orbweave
