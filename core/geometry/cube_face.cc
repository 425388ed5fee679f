// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/cube_face.h"

#include <array>
#include <cmath>

#include "core/base/status.h"

namespace orbweave {
namespace {

Eigen::Matrix3d Rows(const Eigen::Vector3d& down, const Eigen::Vector3d& out) {
  Eigen::Matrix3d rotation;
  rotation << down.cross(out).transpose(), down.transpose(), out.transpose();
  return rotation;
}

std::array<Eigen::Matrix3d, kCubeFaces> MakeFaces() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  return {Rows(y, z), Rows(y, x), Rows(y, -z), Rows(y, -x), Rows(z, -y), Rows(-z, y)};
}

}  // namespace

const Eigen::Matrix3d& FaceFromCamera(int face) {
  static const std::array<Eigen::Matrix3d, kCubeFaces> kFaces = MakeFaces();
  ORBWEAVE_CHECK(face >= 0 && face < kCubeFaces);
  return kFaces[static_cast<size_t>(face)];
}

int FaceOf(const Eigen::Vector3d& bearing_in_cam) {
  const double x = bearing_in_cam.x();
  const double y = bearing_in_cam.y();
  const double z = bearing_in_cam.z();
  const std::array<double, kCubeFaces> along_axis = {z, x, -z, -x, -y, y};
  int best = 0;
  for (int face = 1; face < kCubeFaces; ++face) {
    if (along_axis[static_cast<size_t>(face)] > along_axis[static_cast<size_t>(best)]) best = face;
  }
  return best;
}

Rigid3 FaceFromWorld(int face, const Rigid3& cam_from_world) {
  const Eigen::Quaterniond face_from_cam(FaceFromCamera(face));
  return {(face_from_cam * cam_from_world.rotation).normalized(),
          FaceFromCamera(face) * cam_from_world.translation};
}

Eigen::Vector3d PinholeFace::BearingFromPixel(const Eigen::Vector2d& pixel) const {
  return Eigen::Vector3d(pixel.x() - Principal_px(), pixel.y() - Principal_px(), Focal_px())
      .normalized();
}

Eigen::Vector2d PinholeFace::PixelFromBearing(const Eigen::Vector3d& bearing_in_face) const {
  return {Principal_px() + Focal_px() * bearing_in_face.x() / bearing_in_face.z(),
          Principal_px() + Focal_px() * bearing_in_face.y() / bearing_in_face.z()};
}

}  // namespace orbweave
