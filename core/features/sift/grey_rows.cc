// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/grey_rows.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/features/row_across_poles.h"

namespace orbweave::internal {

GreyRows::GreyRows(const cv::Mat& panorama, bool doubled)
    : panorama_(panorama), doubled_(doubled), mixed_(static_cast<size_t>(panorama.cols) + 2) {
  for (Kept& kept : kept_) kept.greys.resize(mixed_.size());
}

const float* GreyRows::Greys(int row) {
  Kept& kept = kept_[static_cast<size_t>(Modulo(row, 2))];  // neighbours do not replace each other
  if (kept.row == row) return kept.greys.data();
  kept.row = row;
  const SourceRow source = RowAcrossPoles(row, panorama_.rows);
  cv::cvtColor(panorama_.row(source.row), line_, cv::COLOR_BGR2GRAY);
  const uint8_t* const bytes = line_.ptr();
  const int width = panorama_.cols;
  const int turn = source.turned ? width / 2 : 0;
  float* const greys = kept.greys.data();
  for (int x = turn; x < width; ++x) greys[1 + x - turn] = bytes[x];
  for (int x = 0; x < turn; ++x) greys[1 + width - turn + x] = bytes[x];
  greys[0] = greys[width];
  greys[width + 1] = greys[1];
  return greys;
}

void GreyRows::Write(int y, float* out) {
  const int width = panorama_.cols;
  if (!doubled_) {
    std::copy_n(Greys(y) + 1, width, out);
    return;
  }
  const int near_row = y / 2;
  const float* const near = Greys(near_row);
  const float* const other = Greys(y % 2 == 0 ? near_row - 1 : near_row + 1);
  float* const mixed = mixed_.data();
  for (int x = 0; x < width + 2; ++x) mixed[x] = 0.75F * near[x] + 0.25F * other[x];
  for (int x = 0; x < width; ++x) {
    out[2 * x] = 0.75F * mixed[x + 1] + 0.25F * mixed[x];
    out[2 * x + 1] = 0.75F * mixed[x + 1] + 0.25F * mixed[x + 2];
  }
}

}  // namespace orbweave::internal
