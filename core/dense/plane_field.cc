// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/plane_field.h"

#include <algorithm>
#include <limits>

#include "core/dense/equiangular_raster.h"

namespace orbweave {

PlaneField::PlaneField(int face_px)
    : face_px_(face_px),
      rows_(face_px + 2 * kApron_px),
      places_(rows_ / 2 + static_cast<int>(kMatchLanes)) {  // the last lanes may run over
  const size_t size = At(kCubeFaces, 0, 0, 0);
  for (std::vector<float>* values : {&x, &y, &z}) values->assign(size, 0.0F);
  cost.assign(size, 2.0F);
  sigma.assign(size, std::numeric_limits<float>::infinity());
  const EquiangularRaster raster{face_px};
  const auto inside = [&](int k) { return k >= kApron_px && k < kApron_px + face_px; };
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < rows_; ++column) {
        if (inside(row) && inside(column)) continue;
        const auto place = raster.PixelFromBearing(
            raster.BearingFromPixel(face, row - kApron_px + 0.5, column - kApron_px + 0.5));
        const int from_row = std::clamp(static_cast<int>(place.row), 0, face_px - 1) + kApron_px;
        const int from_column =
            std::clamp(static_cast<int>(place.column), 0, face_px - 1) + kApron_px;
        copies_.push_back({static_cast<uint32_t>(AtPixel(place.face, from_row, from_column)),
                           static_cast<uint32_t>(AtPixel(face, row, column)),
                           static_cast<uint8_t>(kCubeFaces * face + place.face)});
      }
    }
  }
  for (int to = 0; to < kCubeFaces; ++to) {
    for (int from = 0; from < kCubeFaces; ++from) {
      const Eigen::Matrix3d turn = FaceFromCamera(to) * FaceFromCamera(from).transpose();
      auto& entries = turns_[static_cast<size_t>(kCubeFaces * to + from)];
      for (size_t k = 0; k < 9; ++k)
        entries[k] = static_cast<float>(turn(static_cast<int>(k / 3), static_cast<int>(k % 3)));
    }
  }
}

void PlaneField::FillAprons() {
  for (const Copy& copy : copies_) {
    const auto& R = turns_[copy.turn];
    const float a = x[copy.from];
    const float b = y[copy.from];
    const float c = z[copy.from];
    x[copy.to] = R[0] * a + R[1] * b + R[2] * c;
    y[copy.to] = R[3] * a + R[4] * b + R[5] * c;
    z[copy.to] = R[6] * a + R[7] * b + R[8] * c;
    cost[copy.to] = cost[copy.from];
  }
}

}  // namespace orbweave
