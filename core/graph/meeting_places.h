// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/graph/adjacency.h"

namespace orbweave {

/// An edge between two parts.
struct CutEdge {
  uint32_t in_a = 0;
  uint32_t in_b = 0;
  uint32_t edge = 0;
};

/// A place where two parts meet: cut edges whose images hang together by strong links among them.
using MeetingPlace = std::vector<CutEdge>;

/// The places where every two parts (a < b) meet. Two halves of a block meet at two places, parts
/// of a grid of streets wherever a street was cut. Weak links (StrongLinks) make no place, as two
/// that look alike would: they count where one of their images is at a place, else nowhere. Parts
/// that only weak links join have one place. Places in order of their first edge, edges sorted by
/// their images. `part_of`: per image; images without an edge may hold anything.
[[nodiscard]] std::map<std::pair<uint32_t, uint32_t>, std::vector<MeetingPlace>> FindMeetingPlaces(
    const Adjacency& adjacency,
    std::span<const double> edge_weight,
    std::span<const uint32_t> part_of);

}  // namespace orbweave
