// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace orbweave {

/// A rectangle of a panorama to be worked on by itself. Tiles' cores cover the panorama without
/// overlap; `padded` adds a margin of context and may reach over every edge of the panorama.
struct Tile {
  cv::Rect core{};
  cv::Rect padded{};
};

/// Corners of cores and padded rectangles are multiples of this, and so are padded sizes: pyramids
/// that halve the image up to four times then sample the same pixels in every tile, and halve
/// exactly.
constexpr int kTileAlignment = 16;

/// Tiles for the rows [first_row, end_row) of a panorama: cores of about `size_px` x `size_px`
/// pixels, as equal as the alignment allows, with at least `margin_px` around each.
[[nodiscard]] std::vector<Tile> PlanTiles(
    cv::Size panorama, int first_row, int end_row, int size_px, int margin_px);

/// Copies a rectangle out of a panorama as if the sphere were flat around it: columns continue
/// across the +-180 degree seam, rows continue across the poles half a turn further on.
[[nodiscard]] cv::Mat CutTile(const cv::Mat& panorama, const cv::Rect& rect);

}  // namespace orbweave
