// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_tiles/plan_tiles.h"

#include <algorithm>

namespace orbweave {

void TilePlanner::Add(const TileRuns& runs) {
  for (const PointsOfCell& run : runs.runs) {
    Pieces& pieces = tiles_[run.cell];
    if (pieces.all.empty() || run.count > max_points_ - pieces.points_of_last) {
      pieces.all.push_back({.cell = run.cell, .piece = static_cast<uint32_t>(pieces.all.size())});
      pieces.points_of_last = 0;
    }
    pieces.all.back().points.push_back(run.points);
    pieces.points_of_last += std::min(run.count, max_points_);
  }
}

std::vector<TileRecipe> TilePlanner::Recipes() const {
  std::vector<TileRecipe> recipes;
  for (const auto& [cell, pieces] : tiles_)
    recipes.insert(recipes.end(), pieces.all.begin(), pieces.all.end());
  return recipes;
}

}  // namespace orbweave
