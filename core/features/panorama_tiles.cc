// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/panorama_tiles.h"

#include <algorithm>
#include <cstring>

#include "core/features/row_across_poles.h"

namespace orbweave {
namespace {

int FloorTo(int value, int step) {
  return value >= 0 ? value / step * step : -((-value + step - 1) / step * step);
}
int CeilTo(int value, int step) { return -FloorTo(-value, step); }

struct Interval {
  int begin = 0;
  int end = 0;
};

/// [begin, end) in aligned pieces of at most about `size`.
std::vector<Interval> Split(int begin, int end, int size) {
  const int pieces = std::max(1, (end - begin + size - 1) / size);
  const int step = CeilTo((end - begin + pieces - 1) / pieces, kTileAlignment);
  std::vector<Interval> intervals;
  for (int at = begin; at < end; at += step) intervals.push_back({at, std::min(at + step, end)});
  return intervals;
}

Interval Padded(const Interval& core, int margin) {
  return {FloorTo(core.begin - margin, kTileAlignment), CeilTo(core.end + margin, kTileAlignment)};
}

}  // namespace

std::vector<Tile> PlanTiles(
    cv::Size panorama, int first_row, int end_row, int size_px, int margin_px) {
  std::vector<Tile> tiles;
  const int aligned_first_row = FloorTo(std::max(0, first_row), kTileAlignment);
  for (const Interval& y : Split(aligned_first_row, std::min(end_row, panorama.height), size_px)) {
    for (const Interval& x : Split(0, panorama.width, size_px)) {
      const Interval px = Padded(x, margin_px);
      const Interval py = Padded(y, margin_px);
      tiles.push_back({{x.begin, y.begin, x.end - x.begin, y.end - y.begin},
                       {px.begin, py.begin, px.end - px.begin, py.end - py.begin}});
    }
  }
  return tiles;
}

cv::Mat CutTile(const cv::Mat& panorama, const cv::Rect& rect) {
  cv::Mat tile(rect.size(), panorama.type());
  const size_t pixel_bytes = panorama.elemSize();
  for (int y = 0; y < rect.height; ++y) {
    const SourceRow source = RowAcrossPoles(rect.y + y, panorama.rows);
    const uint8_t* const from = panorama.ptr(source.row);
    const int turn = source.turned ? panorama.cols / 2 : 0;
    for (int x = 0; x < rect.width;) {
      const int column = Modulo(rect.x + x + turn, panorama.cols);
      const int run = std::min(rect.width - x, panorama.cols - column);
      std::memcpy(tile.ptr(y, x),
                  from + pixel_bytes * static_cast<size_t>(column),
                  pixel_bytes * static_cast<size_t>(run));
      x += run;
    }
  }
  return tile;
}

}  // namespace orbweave
