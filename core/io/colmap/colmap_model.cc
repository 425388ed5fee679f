// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap/colmap_model.h"

#include <cmath>
#include <set>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/byte_stream.h"
#include "core/io/file.h"

namespace orbweave {
namespace {

constexpr int kMaxSidePx = 1 << 20;

absl::Status Damaged(const std::string& path, const ByteReader& in) {
  return absl::InvalidArgumentError(
      absl::StrCat(path, ": no COLMAP model file, or damaged, at byte ", in.Position()));
}

absl::Status ReadCameras(const std::string& path, ColmapModel& model) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  ByteReader in(bytes);
  for (size_t left = in.TakeCount(40); left > 0 && in.ok(); --left) {
    ColmapCamera& camera = model.cameras.emplace_back();
    camera.camera_id = in.Take<uint32_t>();
    const int32_t kind = in.Take<int32_t>();
    const uint64_t width_px = in.Take<uint64_t>();
    const uint64_t height_px = in.Take<uint64_t>();
    if (in.ok() && kind != kColmapEquirectangularId && kind != kColmapSphereId) {
      return absl::InvalidArgumentError(
          absl::StrCat(path,
                       ": camera ",
                       camera.camera_id,
                       " has model ",
                       kind,
                       "; only EQUIRECTANGULAR (17) and SPHERE (11) are spherical"));
    }
    for (int i = 0; i < (kind == kColmapSphereId ? 3 : 2); ++i) in.Take<double>();
    if (!in.ok() || width_px == 0 || width_px > kMaxSidePx || height_px == 0 ||
        height_px > kMaxSidePx) {
      return Damaged(path, in);
    }
    camera.camera = {static_cast<int>(width_px), static_cast<int>(height_px)};
  }
  return in.ok() && in.AtEnd() ? absl::OkStatus() : Damaged(path, in);
}

Rigid3 TakePose(ByteReader& in) {
  double v[7];
  for (double& value : v) value = in.Take<double>();
  return {Eigen::Quaterniond(v[0], v[1], v[2], v[3]), {v[4], v[5], v[6]}};
}

absl::Status ReadImages(const std::string& path, ColmapModel& model) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  ByteReader in(bytes);
  for (size_t left = in.TakeCount(73); left > 0 && in.ok(); --left) {
    ColmapImage& image = model.images.emplace_back();
    image.image_id = in.Take<uint32_t>();
    image.cam_from_world = TakePose(in);
    image.camera_id = in.Take<uint32_t>();
    image.name = in.TakeText();
    image.points2d.resize(in.TakeCount(24));
    for (ColmapPoint2d& point : image.points2d) {
      point.pixel.x() = in.Take<double>();
      point.pixel.y() = in.Take<double>();
      point.point3d_id = in.Take<uint64_t>();
    }
    const double norm = image.cam_from_world.rotation.norm();
    if (!in.ok() || !(std::abs(norm - 1.0) < 1e-3)) return Damaged(path, in);
    image.cam_from_world.rotation.coeffs() /= norm;
  }
  return in.ok() && in.AtEnd() ? absl::OkStatus() : Damaged(path, in);
}

absl::Status ReadPoints(const std::string& path, ColmapModel& model) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  ByteReader in(bytes);
  for (size_t left = in.TakeCount(51); left > 0 && in.ok(); --left) {
    ColmapPoint3d& point = model.points.emplace_back();
    point.point3d_id = in.Take<uint64_t>();
    for (int axis = 0; axis < 3; ++axis) point.point_in_world[axis] = in.Take<double>();
    point.color.r = in.Take<uint8_t>();
    point.color.g = in.Take<uint8_t>();
    point.color.b = in.Take<uint8_t>();
    point.error_px = in.Take<double>();
    point.track.resize(in.TakeCount(8));
    for (auto& [image_id, index] : point.track) {
      image_id = in.Take<uint32_t>();
      index = in.Take<uint32_t>();
    }
  }
  return in.ok() && in.AtEnd() ? absl::OkStatus() : Damaged(path, in);
}

/// Every name used is defined.
absl::Status CheckReferences(const std::string& folder, const ColmapModel& model) {
  std::set<uint32_t> cameras;
  for (const ColmapCamera& camera : model.cameras) cameras.insert(camera.camera_id);
  std::set<uint64_t> points;
  for (const ColmapPoint3d& point : model.points) points.insert(point.point3d_id);
  for (const ColmapImage& image : model.images) {
    if (!cameras.contains(image.camera_id)) {
      return absl::InvalidArgumentError(absl::StrCat(folder,
                                                     ": image ",
                                                     image.name,
                                                     " has camera ",
                                                     image.camera_id,
                                                     ", which is not in cameras.bin"));
    }
    for (const ColmapPoint2d& point : image.points2d) {
      if (point.point3d_id != kNoColmapPoint && !points.contains(point.point3d_id)) {
        return absl::InvalidArgumentError(absl::StrCat(folder,
                                                       ": image ",
                                                       image.name,
                                                       " sees point ",
                                                       point.point3d_id,
                                                       ", which is not in points3D.bin"));
      }
    }
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<ColmapModel> ReadColmapModel(const std::string& folder) {
  ColmapModel model;
  ORBWEAVE_RETURN_IF_ERROR(ReadCameras(folder + "/cameras.bin", model));
  ORBWEAVE_RETURN_IF_ERROR(ReadImages(folder + "/images.bin", model));
  ORBWEAVE_RETURN_IF_ERROR(ReadPoints(folder + "/points3D.bin", model));
  ORBWEAVE_RETURN_IF_ERROR(CheckReferences(folder, model));
  return model;
}

}  // namespace orbweave
