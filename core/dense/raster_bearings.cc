// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/raster_bearings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/geometry/cube_face.h"

namespace orbweave {

RasterBearings::RasterBearings(EquiangularRaster raster) : raster_(raster) {
  for (int i = 0; i < raster.face_px; ++i) {
    tangents_.push_back(std::tan((i + 0.5) * raster.PixelAngle() - 0.25 * std::numbers::pi));
  }
}

Eigen::Vector3d RasterBearings::Of(size_t index) const {
  const auto size = static_cast<uint32_t>(raster_.face_px);
  const auto in_raster = static_cast<uint32_t>(index);  // short divisions are fast
  const uint32_t line = in_raster / size;
  const Eigen::Vector3d bearing(tangents_[in_raster % size], tangents_[line % size], 1.0);
  return FaceFromCamera(static_cast<int>(line / size)).transpose() * bearing.normalized();
}

bool RasterBearings::AddBlock(const EquiangularRaster::Place& place,
                              const Eigen::Vector3d& bearing,
                              double limit_chord,
                              std::vector<size_t>& pixels) const {
  const auto row = static_cast<int>(std::floor(place.row));
  const auto column = static_cast<int>(std::floor(place.column));
  if (std::min(row, column) < 1 || std::max(row, column) > raster_.face_px - 2) return false;
  const Eigen::Vector3d in_face = FaceFromCamera(place.face) * bearing;
  const double least_cosine = 1.0 - 0.5 * limit_chord * limit_chord;
  for (int i = row - 1; i <= row + 1; ++i) {
    const double y = tangents_[static_cast<size_t>(i)];
    for (int k = column - 1; k <= column + 1; ++k) {
      const double x = tangents_[static_cast<size_t>(k)];
      const double along = x * in_face.x() + y * in_face.y() + in_face.z();
      if (along >= least_cosine * std::sqrt(x * x + y * y + 1.0)) {
        pixels.push_back(raster_.Index(place.face, i, k));
      }
    }
  }
  return true;
}

void RasterBearings::Around(const Eigen::Vector3d& bearing,
                            double limit_px,
                            std::vector<size_t>& pixels) const {
  pixels.clear();
  const double limit_chord = limit_px * raster_.PixelAngle();
  const EquiangularRaster::Place place = raster_.PixelFromBearing(bearing);
  if (AddBlock(place, bearing, limit_chord, pixels)) return;
  for (int i = -3; i <= 3; ++i) {
    for (int k = -3; k <= 3; ++k) {
      const Eigen::Vector3d beside =
          raster_.BearingFromPixel(place.face, place.row + 0.5 * i, place.column + 0.5 * k);
      const size_t index = raster_.Index(raster_.PixelFromBearing(beside));
      if ((Of(index) - bearing).norm() <= limit_chord) pixels.push_back(index);
    }
  }
  std::ranges::sort(pixels);
  const auto repeated = std::ranges::unique(pixels);
  pixels.erase(repeated.begin(), repeated.end());
}

}  // namespace orbweave
