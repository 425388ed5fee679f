// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/artifacts/dense_records.h"

namespace orbweave {

/// Collects which panorama has points in which tile. A tile of more than `max_points` is cut into
/// pieces, each with all points that some panoramas have there: at most max_points, or those of a
/// single panorama.
class TilePlanner {
 public:
  explicit TilePlanner(uint64_t max_points) : max_points_(max_points) {}

  /// Panoramas in the job's order.
  void Add(const TileRuns& runs);

  /// Ascending by cell and piece.
  [[nodiscard]] std::vector<TileRecipe> Recipes() const;

 private:
  struct Pieces {
    std::vector<TileRecipe> all{};
    uint64_t points_of_last = 0;
  };

  uint64_t max_points_;
  std::map<TileCell, Pieces> tiles_{};
};

}  // namespace orbweave
