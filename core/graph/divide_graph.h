// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/graph/adjacency.h"

namespace orbweave {

/// Images of one connected piece of a view graph, its links and its edge weights.
struct ConnectedPiece {
  const Adjacency& adjacency;
  std::span<const double> edge_weight{};  ///< per edge of the graph, > 0
  std::span<const uint32_t> images{};     ///< sorted
};

/// Divides a connected piece into at most `num_parts` connected parts of about equal size with a
/// small weight of cut edges: METIS k-way (Karypis, Kumar, SIAM J. Sci. Comput. 1998), then stray
/// images of a part and parts smaller than `min_part_size` go to the neighbour with which they
/// share most weight. Sorted lists of images, sorted by their first image. Deterministic as long as
/// no other thread draws from the C library's rand(), which METIS uses. Internal when METIS fails.
[[nodiscard]] absl::StatusOr<std::vector<std::vector<uint32_t>>> DivideGraph(
    const ConnectedPiece& piece, uint32_t num_parts, uint32_t min_part_size);

}  // namespace orbweave
