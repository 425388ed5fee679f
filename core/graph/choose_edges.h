// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/graph/build_view_graph.h"
#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

struct ChosenEdges {
  ViewGraph graph{};
  std::vector<DroppedEdge> dropped{};  ///< in the order of the filters
};

/// The view graph of all verified pairs: without those that contradict GNSS (DropEdgesAgainstGnss),
/// stated headings (DropEdgesAgainstCompass), the sequence of their drive (DropEdgesAgainstChain),
/// their triangles (BuildViewGraph), or the headings that all others agree on
/// (DropEdgesAgainstHeadings), one filter after the other. Positions are those that the motion of
/// the drives leaves (PositionsByMotion): one that is off between houses speaks against no pair;
/// and what the names between those tell of images without one (PlaceByName).
[[nodiscard]] ChosenEdges ChooseEdges(const std::vector<ViewEdge>& edges,
                                      const ImageManifest& manifest,
                                      const ViewGraphOptions& options);

}  // namespace orbweave
