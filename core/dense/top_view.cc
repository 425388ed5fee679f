// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/dense/top_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/base/status.h"

namespace orbweave {
namespace {

/// The world's x without its part along `up`, or its y where that leaves next to nothing.
Eigen::Vector3d RightOf(const Eigen::Vector3d& up) {
  const Eigen::Vector3d east = Eigen::Vector3d::UnitX() - up.x() * up;
  if (east.norm() > 0.1) return east.normalized();
  return (Eigen::Vector3d::UnitY() - up.y() * up).normalized();
}

}  // namespace

TopView::TopView(const Eigen::Vector3d& up, double pixel, int max_side_px)
    : right_(RightOf(up)),
      ahead_(up.cross(right_)),
      up_(up),
      pixel_(pixel),
      max_side_px_(max_side_px) {
  ORBWEAVE_CHECK(pixel > 0.0 && max_side_px >= 2);
}

TopView::Extent TopView::Union(const Extent& a, const Extent& b) {
  if (a.IsEmpty()) return b;
  if (b.IsEmpty()) return a;
  return {std::min(a.left, b.left),
          std::max(a.right, b.right),
          std::min(a.low, b.low),
          std::max(a.high, b.high)};
}

TopView::Extent TopView::Halved(const Extent& extent) {
  if (extent.IsEmpty()) return extent;
  return {extent.left >> 1, extent.right >> 1, extent.low >> 1, extent.high >> 1};
}

int64_t TopView::PixelOf(const SurfacePoint& point, const Eigen::Vector3d& axis) const {
  return static_cast<int64_t>(std::floor(axis.dot(point.position_in_world) / pixel_));
}

TopView::Extent TopView::ExtentOf(std::span<const SurfacePoint> points) const {
  Extent extent;
  for (const SurfacePoint& point : points) {
    const int64_t column = PixelOf(point, right_);
    const int64_t row = PixelOf(point, ahead_);
    extent = Union(extent, {column, column, row, row});
  }
  return extent;
}

TopView::Cell& TopView::At(int64_t column, int64_t row) {
  return cells_[static_cast<size_t>((row - held_.low) * held_.Width() + column - held_.left)];
}

void TopView::Show(int64_t column, int64_t row, const Cell& cell) {
  Cell& shown = At(column, row);
  const auto rank = [](const Cell& of) {
    return std::tuple(of.height, of.color.r, of.color.g, of.color.b);
  };
  if (!shown.seen || rank(cell) > rank(shown)) shown = cell;
}

/// Holds `held`; what was held goes to pixels that are 2^shift as large.
void TopView::Rebuild(const Extent& held, int shift) {
  const Extent before = std::exchange(held_, held);
  const std::vector<Cell> cells =
      std::exchange(cells_, std::vector<Cell>(static_cast<size_t>(held.Width() * held.Height())));
  size_t k = 0;
  for (int64_t row = before.low; row <= before.high; ++row) {
    for (int64_t column = before.left; column <= before.right; ++column, ++k) {
      if (cells[k].seen) Show(column >> shift, row >> shift, cells[k]);
    }
  }
}

void TopView::Add(std::span<const SurfacePoint> points) {
  Extent wanted = Union(used_, ExtentOf(points));
  if (wanted.IsEmpty()) return;
  int shift = 0;
  while (wanted.Width() > max_side_px_ || wanted.Height() > max_side_px_) {
    wanted = Halved(wanted);
    pixel_ *= 2.0;
    ++shift;
  }
  used_ = wanted;
  const bool fits = !held_.IsEmpty() && held_.left <= used_.left && held_.right >= used_.right &&
                    held_.low <= used_.low && held_.high >= used_.high;
  if (shift > 0 || !fits) {
    const int64_t across = used_.Width() / 8;
    const int64_t along = used_.Height() / 8;
    Rebuild({used_.left - across, used_.right + across, used_.low - along, used_.high + along},
            shift);
  }
  for (const SurfacePoint& point : points) {
    Show(PixelOf(point, right_),
         PixelOf(point, ahead_),
         {static_cast<float>(up_.dot(point.position_in_world)), point.color, true});
  }
}

TopPicture TopView::Picture() const {
  TopPicture picture{.pixel = pixel_, .right = right_, .ahead = ahead_};
  if (used_.IsEmpty()) return picture;
  picture.width_px = static_cast<int>(used_.Width());
  picture.height_px = static_cast<int>(used_.Height());
  picture.corner = {pixel_ * static_cast<double>(used_.left),
                    pixel_ * static_cast<double>(used_.high + 1)};
  picture.rgba.reserve(4 * static_cast<size_t>(used_.Width() * used_.Height()));
  for (int64_t row = used_.high; row >= used_.low; --row) {
    const auto first = (row - held_.low) * held_.Width() + used_.left - held_.left;
    for (const Cell& cell : std::span(cells_).subspan(static_cast<size_t>(first),
                                                      static_cast<size_t>(used_.Width()))) {
      const uint8_t alpha = cell.seen ? 255 : 0;
      picture.rgba.insert(picture.rgba.end(), {cell.color.r, cell.color.g, cell.color.b, alpha});
    }
  }
  return picture;
}

}  // namespace orbweave
