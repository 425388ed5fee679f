// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/graph/sifted_edges.h"
#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// Edges without those that the sequence of a drive rules out: places that look alike.
///
/// The steps v_k of a drive from image a to image b (DriveChain) are known up to how deep the scene
/// is at each of them: C_b - C_a = sum d_k v_k. The edge of a and b says that this is d l e, with
/// the direction e and the baseline over depth l. The depths along a way of n steps differ from
/// each other by up to f^2 either way, f = exp(0.1 (1 + sqrt n)): their logarithm wanders by a
/// tenth a step. When for some direction u even the depths that suit the edge best leave
///
///   sum_k (u . v_k > 0 ? 1 / f : f) u . v_k - 0.1 sum_k |v_k| - max(0, 2 l u . e)
///
/// above 0.3 depths, no depths bring the drive to where the edge wants it (0.1 rad: drift of
/// directions): it is dropped. A drive that comes back has as much behind it as before it along
/// every u, and keeps its edges. Of edges among neighbours that may see far (MaySeeFar) only
/// those that point against the way are dropped. So is an edge that turns otherwise
/// than the drive by more than 15 degrees and half a degree times sqrt n.
///
/// Nothing is said of images of two drives, across places where the sequence breaks, and of images
/// that GNSS puts within 3 sigmas of each other.
[[nodiscard]] SiftedEdges DropEdgesAgainstChain(const std::vector<ViewEdge>& edges,
                                                const ImageManifest& manifest);

}  // namespace orbweave
