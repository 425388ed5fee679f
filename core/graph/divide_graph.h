// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/graph/adjacency.h"
#include "core/graph/strong_links.h"

namespace orbweave {

/// Images of one connected piece of a view graph, its links and weights.
struct ConnectedPiece {
  const Adjacency& adjacency;
  const StrongLinks& strong;              ///< of the whole graph, by edge_weight
  std::span<const double> edge_weight{};  ///< per edge of the graph, > 0: how it holds
  std::span<const double> cut_cost{};     ///< per edge, > 0; empty: edge_weight
  std::span<const double> image_cost{};   ///< per image of the graph, about 1
  std::span<const uint32_t> images{};     ///< sorted
};

/// METIS's own default for its k-way division.
constexpr double kUsualUnevenness = 0.03;

/// Divides a connected piece into about `num_parts` parts of about equal cost with a small weight
/// of cut edges (cut_cost): METIS k-way (Karypis, Kumar, SIAM J. Sci. Comput. 1998), which also
/// makes parts that hang together by their weakest links alone, around images of another part. So
/// each part is taken as the chunks that its strong links hold together. The largest is the part;
/// others of half the usual size are parts as well; what is smaller, and all of fewer than
/// `min_part_size` images, joins the neighbour with which it shares most weight. METIS's parts cost
/// at most 1 + `unevenness` times the mean. Sorted lists of images, sorted by their first image.
/// Deterministic as long as no other thread draws from the C library's rand(), which METIS uses.
/// Internal when METIS fails.
[[nodiscard]] absl::StatusOr<std::vector<std::vector<uint32_t>>> DivideGraph(
    const ConnectedPiece& piece,
    uint32_t num_parts,
    uint32_t min_part_size,
    double unevenness = kUsualUnevenness);

}  // namespace orbweave
