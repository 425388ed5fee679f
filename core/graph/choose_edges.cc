// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/choose_edges.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/graph/drop_edges_against_chain.h"
#include "core/graph/drop_edges_against_compass.h"
#include "core/graph/drop_edges_against_gnss.h"
#include "core/graph/drop_edges_against_headings.h"
#include "core/graph/drop_edges_against_way.h"
#include "core/graph/positions_by_motion.h"
#include "core/graph/positions_by_name.h"

namespace orbweave {
namespace {

/// With priors that the motion of their drives leaves, or the names between those.
ImageManifest PlacedBySequence(const std::vector<ViewEdge>& edges, ImageManifest manifest) {
  const std::vector<PositionByMotion> positions = PositionsByMotion(manifest);
  for (ImageRecord& image : manifest.images) image.prior = positions[image.id.value].prior;
  PlaceByName(edges, manifest);
  return manifest;
}

}  // namespace

ChosenEdges ChooseEdges(const std::vector<ViewEdge>& edges,
                        const ImageManifest& manifest,
                        const ViewGraphOptions& options) {
  const ImageManifest placed = PlacedBySequence(edges, manifest);
  SiftedEdges by_gnss = DropEdgesAgainstGnss(edges, placed);
  SiftedEdges by_compass = DropEdgesAgainstCompass(by_gnss.kept, manifest);
  SiftedEdges by_way = DropEdgesAgainstWay(by_compass.kept, manifest);
  SiftedEdges by_chain = DropEdgesAgainstChain(by_way.kept, manifest);
  SiftedEdges by_heading = DropEdgesAgainstHeadings(by_chain.kept, placed);
  FilteredViewGraph filtered = BuildViewGraph(
      static_cast<uint32_t>(manifest.images.size()), std::move(by_heading.kept), options);
  ChosenEdges chosen{.graph = std::move(filtered.graph), .dropped = std::move(by_gnss.dropped)};
  for (std::vector<DroppedEdge>* dropped : {&by_compass.dropped,
                                            &by_way.dropped,
                                            &by_chain.dropped,
                                            &by_heading.dropped,
                                            &filtered.dropped}) {
    std::ranges::move(*dropped, std::back_inserter(chosen.dropped));
  }
  return chosen;
}

}  // namespace orbweave
