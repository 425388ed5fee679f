// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/equiangular_raster.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/cube_face.h"

namespace orbweave {

using std::numbers::pi;

double EquiangularRaster::PixelAngle() const { return 0.5 * pi / face_px; }

Eigen::Vector3d EquiangularRaster::BearingFromPixel(int face, double row, double column) const {
  const Eigen::Vector3d in_face(
      std::tan(column * PixelAngle() - 0.25 * pi), std::tan(row * PixelAngle() - 0.25 * pi), 1.0);
  return FaceFromCamera(face).transpose() * in_face.normalized();
}

EquiangularRaster::Place EquiangularRaster::PixelFromBearing(const Eigen::Vector3d& bearing) const {
  const int face = FaceOf(bearing);
  const Eigen::Vector3d in_face = FaceFromCamera(face) * bearing;
  const double pixels_per_rad = 1.0 / PixelAngle();
  return {face,
          (std::atan2(in_face.y(), in_face.z()) + 0.25 * pi) * pixels_per_rad,
          (std::atan2(in_face.x(), in_face.z()) + 0.25 * pi) * pixels_per_rad};
}

size_t EquiangularRaster::Index(const Place& place) const {
  return Index(place.face,
               std::clamp(static_cast<int>(place.row), 0, face_px - 1),
               std::clamp(static_cast<int>(place.column), 0, face_px - 1));
}

}  // namespace orbweave
