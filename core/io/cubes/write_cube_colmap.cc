// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/cubes/write_cube_colmap.h"

#include <algorithm>
#include <utility>

#include "core/base/status.h"
#include "core/geometry/rotation.h"
#include "core/io/byte_stream.h"
#include "core/io/colmap/colmap_bytes.h"

namespace orbweave {
namespace {

constexpr int32_t kPinholeId = 1;
constexpr int32_t kCameraSensor = 0;

uint32_t ImageIdOf(ImageId id, int face) {
  return kCubeFaces * id.value + static_cast<uint32_t>(face) + 1;
}
uint32_t FrameIdOf(ImageId id) { return id.value + 1; }
uint32_t CameraIdOf(uint32_t rig, int face) {
  return kCubeFaces * rig + static_cast<uint32_t>(face) + 1;
}

}  // namespace

CubeColmapWriter::CubeColmapWriter(const std::string& folder,
                                   const std::map<ImageId, RegisteredImage>& images,
                                   const ImageManifest& manifest,
                                   const CubeLayout& layout)
    : folder_(folder),
      images_(images),
      manifest_(manifest),
      layout_(layout),
      rigs_(CubeRigs(images, manifest, layout)),
      points_file_(folder + "/points3D.bin") {
  points_file_.Append(ColmapCount(0));
}

uint32_t CubeColmapWriter::RigOf(ImageId id) const {
  const PinholeFace pinhole = layout_.FaceOf(manifest_.At(id).camera);
  return static_cast<uint32_t>(std::ranges::find(rigs_, pinhole) - rigs_.begin());
}

void CubeColmapWriter::AddPoint(const Track& track) {
  const auto known = [&](const Observation& seen) { return images_.contains(seen.ref.image); };
  const auto count = std::ranges::count_if(track.observations, known);
  if (count < 2) return;
  const uint64_t point = ++num_points_;
  ByteWriter elements;
  double error_px = 0.0;
  for (const Observation& seen : track.observations) {
    if (!known(seen)) continue;
    const ImageId id = seen.ref.image;
    const PinholeFace pinhole = layout_.FaceOf(manifest_.At(id).camera);
    const auto [face, pixel] = ObserveOnCube(seen.bearing, pinhole);
    std::vector<SeenPoint>& on_face = seen_[id][static_cast<size_t>(face)];
    elements.Put(ImageIdOf(id, face)).Put(static_cast<uint32_t>(on_face.size()));
    on_face.push_back({pixel, point});
    const Eigen::Vector3d ray = images_.at(id).cam_from_world * track.point_in_world;
    error_px += pinhole.Focal_px() * AngleBetween(seen.bearing, ray);
  }
  const Eigen::Vector3d& X = track.point_in_world;
  ByteWriter out;
  out.Put(point).Put(X.x()).Put(X.y()).Put(X.z());
  out.Put(track.color.r).Put(track.color.g).Put(track.color.b);
  out.Put(error_px / static_cast<double>(count)).Put(static_cast<uint64_t>(count));
  points_file_.Append(out.PutText(elements.Take()).Take());
}

std::string CubeColmapWriter::CamerasBin() const {
  ByteWriter out;
  out.Put<uint64_t>(kCubeFaces * rigs_.size());
  for (uint32_t rig = 0; rig < rigs_.size(); ++rig) {
    const PinholeFace& pinhole = rigs_[rig];
    const auto size_px = static_cast<uint64_t>(pinhole.size_px);
    for (int face = 0; face < kCubeFaces; ++face) {
      out.Put(CameraIdOf(rig, face)).Put(kPinholeId).Put(size_px).Put(size_px);
      out.Put(pinhole.Focal_px()).Put(pinhole.Focal_px());
      out.Put(pinhole.Principal_px()).Put(pinhole.Principal_px());
    }
  }
  return out.Take();
}

std::string CubeColmapWriter::RigsBin() const {
  ByteWriter out;
  out.Put<uint64_t>(rigs_.size());
  for (uint32_t rig = 0; rig < rigs_.size(); ++rig) {
    out.Put(rig + 1).Put<uint32_t>(kCubeFaces);
    out.Put(kCameraSensor).Put(CameraIdOf(rig, 0));
    for (int face = 1; face < kCubeFaces; ++face) {
      out.Put(kCameraSensor).Put(CameraIdOf(rig, face)).Put<uint8_t>(1);
      PutColmapPose(FaceFromWorld(face, {}), out);
    }
  }
  return out.Take();
}

std::string CubeColmapWriter::FramesBin() const {
  ByteWriter out;
  out.Put<uint64_t>(images_.size());
  for (const auto& [id, image] : images_) {
    const uint32_t rig = RigOf(id);
    out.Put(FrameIdOf(id)).Put(rig + 1);
    PutColmapPose(image.cam_from_world, out);  // the front face's: that of the rig
    out.Put<uint32_t>(kCubeFaces);
    for (int face = 0; face < kCubeFaces; ++face) {
      out.Put(kCameraSensor).Put(CameraIdOf(rig, face));
      out.Put<uint64_t>(ImageIdOf(id, face));
    }
  }
  return out.Take();
}

absl::Status CubeColmapWriter::WriteImages() const {
  AtomicFile file(folder_ + "/images.bin");
  file.Append(ColmapCount(kCubeFaces * images_.size()));
  const Faces none{};
  for (const auto& [id, image] : images_) {
    const auto found = seen_.find(id);
    for (int face = 0; face < kCubeFaces; ++face) {
      const Faces& faces = found == seen_.end() ? none : found->second;
      const std::vector<SeenPoint>& on_face = faces[static_cast<size_t>(face)];
      ByteWriter out;
      out.Put(ImageIdOf(id, face));
      PutColmapPose(FaceFromWorld(face, image.cam_from_world), out);
      out.Put(CameraIdOf(RigOf(id), face));
      out.PutText(CubeImageName(manifest_.At(id), face)).Put<char>('\0');
      out.Put<uint64_t>(on_face.size());
      for (const SeenPoint& seen : on_face) {
        out.Put(seen.pixel.x()).Put(seen.pixel.y()).Put(seen.point);
      }
      file.Append(out.Take());
    }
  }
  return file.Commit();
}

absl::Status CubeColmapWriter::Finish() {
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(folder_ + "/cameras.bin", CamerasBin()));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(folder_ + "/rigs.bin", RigsBin()));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(folder_ + "/frames.bin", FramesBin()));
  ORBWEAVE_RETURN_IF_ERROR(WriteImages());
  return points_file_.CommitWithHead(ColmapCount(num_points_));
}

}  // namespace orbweave
