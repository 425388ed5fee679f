// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap/colmap_model_writer.h"

#include <algorithm>

#include "core/base/status.h"
#include "core/geometry/rotation.h"
#include "core/io/byte_stream.h"
#include "core/io/colmap/colmap_bytes.h"
#include "core/io/colmap/colmap_model.h"

namespace orbweave {
namespace {

uint32_t ColmapId(ImageId id) { return id.value + 1; }

std::string CamerasBin(const std::vector<EquirectangularCamera>& cameras) {
  ByteWriter out;
  out.Put<uint64_t>(cameras.size());
  for (size_t i = 0; i < cameras.size(); ++i) {
    const auto [width_px, height_px] = cameras[i];
    out.Put<uint32_t>(static_cast<uint32_t>(i) + 1).Put<int32_t>(kColmapEquirectangularId);
    out.Put<uint64_t>(static_cast<uint64_t>(width_px))
        .Put<uint64_t>(static_cast<uint64_t>(height_px));
    out.Put<double>(width_px).Put<double>(height_px);
  }
  return out.Take();
}

/// Mean angle between bearings and point, in pixels at the equator.
double MeanErrorPx(const Track& track,
                   const std::map<ImageId, RegisteredImage>& images,
                   const ImageManifest& manifest) {
  double sum = 0.0;
  for (const Observation& seen : track.observations) {
    const Eigen::Vector3d ray_in_cam =
        images.at(seen.ref.image).cam_from_world * track.point_in_world;
    sum +=
        manifest.At(seen.ref.image).camera.PixelsFromAngle(AngleBetween(seen.bearing, ray_in_cam));
  }
  return track.observations.empty() ? 0.0 : sum / static_cast<double>(track.observations.size());
}

}  // namespace

ColmapModelWriter::ColmapModelWriter(const std::string& folder,
                                     const std::map<ImageId, RegisteredImage>& images,
                                     const ImageManifest& manifest)
    : images_(images),
      manifest_(manifest),
      cameras_path_(folder + "/cameras.bin"),
      images_file_(folder + "/images.bin"),
      points_file_(folder + "/points3D.bin") {
  images_file_.Append(ColmapCount(images.size()));
  points_file_.Append(ColmapCount(0));
}

void ColmapModelWriter::AddPoint(const Track& track) {
  const uint64_t point = ++num_points_;
  const Eigen::Vector3d& X = track.point_in_world;
  ByteWriter out;
  out.Put<uint64_t>(point).Put(X.x()).Put(X.y()).Put(X.z());
  out.Put(track.color.r).Put(track.color.g).Put(track.color.b);
  out.Put(MeanErrorPx(track, images_, manifest_)).Put<uint64_t>(track.observations.size());
  for (const Observation& seen : track.observations) {
    out.Put<uint32_t>(ColmapId(seen.ref.image)).Put<uint32_t>(seen.ref.feature);
    point_of_feature_[seen.ref.image].emplace_back(seen.ref.feature, point);
  }
  points_file_.Append(out.Take());
}

void ColmapModelWriter::AddImage(ImageId id, const std::vector<Keypoint>& keypoints) {
  std::vector<uint64_t> points(keypoints.size(), kNoColmapPoint);
  if (const auto seen = point_of_feature_.find(id); seen != point_of_feature_.end()) {
    for (const auto& [feature, point] : seen->second) points.at(feature) = point;
    point_of_feature_.erase(seen);
  }
  const ImageRecord& record = manifest_.At(id);
  ByteWriter out;
  out.Put<uint32_t>(ColmapId(id));
  PutColmapPose(images_.at(id).cam_from_world, out);
  out.Put<uint32_t>(CameraIdOf(record.camera)).PutText(record.name).Put<char>('\0');
  out.Put<uint64_t>(keypoints.size());
  for (size_t i = 0; i < keypoints.size(); ++i) {
    out.Put<double>(keypoints[i].x_px).Put<double>(keypoints[i].y_px).Put<uint64_t>(points[i]);
  }
  images_file_.Append(out.Take());
}

uint32_t ColmapModelWriter::CameraIdOf(const EquirectangularCamera& camera) {
  const auto known = std::ranges::find(cameras_, camera);
  const auto index = static_cast<uint32_t>(known - cameras_.begin());
  if (known == cameras_.end()) cameras_.push_back(camera);
  return index + 1;
}

absl::Status ColmapModelWriter::Finish() {
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(cameras_path_, CamerasBin(cameras_)));
  ORBWEAVE_RETURN_IF_ERROR(images_file_.Commit());
  return points_file_.CommitWithHead(ColmapCount(num_points_));
}

}  // namespace orbweave
