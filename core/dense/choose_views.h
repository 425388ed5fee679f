// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/dense/dense_options.h"
#include "core/dense/match_scale.h"
#include "core/dense/plane_field.h"

namespace orbweave {

inline constexpr int kMaxViews = 4;
inline constexpr int kBlockRows_px = 16;
inline constexpr int kBlockColumns_px = 2 * static_cast<int>(kMatchLanes);

/// The sources that the pixels of a block are matched with, the most promising first.
struct ChosenViews {
  std::array<uint8_t, kMaxViews> source{};
  int count = 0;
};

/// Blocks of a raster of face_px; entry (face * rows + row) * columns + column.
struct BlockViews {
  int rows = 0;
  int columns = 0;
  std::vector<ChosenViews> blocks{};

  [[nodiscard]] const ChosenViews& At(int face, int row, int column) const {
    return blocks[static_cast<size_t>((face * rows + row) * columns + column)];
  }
};

/// By votes of the planes that pixels hold now: a source has the sum of its correlations beyond
/// 0.3, squared, each times how much of 12 degrees of parallax it has; sources by which nothing is
/// to be seen vote last. A quarter of the pixels votes.
[[nodiscard]] BlockViews ChooseViews(const MatchScale& scale,
                                     const PlaneField& field,
                                     const DenseOptions& options,
                                     MatchFunction match);

}  // namespace orbweave
