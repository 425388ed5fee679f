// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/cubes/write_cube_mvs.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/io/byte_stream.h"

namespace orbweave {
namespace {

void PutString(std::string_view text, ByteWriter& out) {
  out.Put<uint64_t>(text.size()).PutText(text);
}

template <typename Matrix>
void PutRows(const Matrix& matrix, ByteWriter& out) {
  for (int row = 0; row < matrix.rows(); ++row) {
    for (int column = 0; column < matrix.cols(); ++column) out.Put<double>(matrix(row, column));
  }
}

void PutCameras(const PinholeFace& pinhole, ByteWriter& out) {
  const double middle = 0.5 * (pinhole.size_px - 1);
  Eigen::Matrix3d K;
  K << pinhole.Focal_px(), 0.0, middle, 0.0, pinhole.Focal_px(), middle, 0.0, 0.0, 1.0;
  out.Put<uint64_t>(kCubeFaces);
  for (int face = 0; face < kCubeFaces; ++face) {
    PutString(CubeFaceName(face), out);
    PutString("", out);  // band
    out.Put(static_cast<uint32_t>(pinhole.size_px)).Put(static_cast<uint32_t>(pinhole.size_px));
    PutRows(K, out);
    PutRows(FaceFromCamera(face), out);
    PutRows(Eigen::Vector3d::Zero(), out);
  }
}

}  // namespace

CubeMvsWriter::CubeMvsWriter(std::string path,
                             const std::map<ImageId, RegisteredImage>& images,
                             const ImageManifest& manifest,
                             const CubeLayout& layout)
    : images_(images), manifest_(manifest), layout_(layout), file_(std::move(path)) {
  uint32_t place = 0;
  for (const auto& [id, image] : images) {
    place_[id] = place;
    place += kCubeFaces;
  }
  file_.Append(Head());
}

std::string CubeMvsWriter::Head() const {
  ByteWriter out;
  out.PutText("MVSI").Put<uint32_t>(5).Put<uint32_t>(0);
  const std::vector<PinholeFace> rigs = CubeRigs(images_, manifest_, layout_);
  std::map<ImageId, std::pair<uint32_t, uint32_t>> pose_of;  // platform, pose
  out.Put<uint64_t>(rigs.size());
  for (uint32_t rig = 0; rig < rigs.size(); ++rig) {
    PutString(absl::StrCat("cube", rig), out);
    PutCameras(rigs[rig], out);
    ByteWriter poses;
    uint32_t count = 0;
    for (const auto& [id, image] : images_) {
      if (layout_.FaceOf(manifest_.At(id).camera) != rigs[rig]) continue;
      pose_of[id] = {rig, count++};
      PutRows(image.cam_from_world.rotation.toRotationMatrix(), poses);
      PutRows(image.cam_from_world.Centre(), poses);
    }
    out.Put<uint64_t>(count).PutText(poses.Take());
  }
  out.Put<uint64_t>(kCubeFaces * images_.size());
  for (const auto& [id, image] : images_) {
    const auto [rig, pose] = pose_of.at(id);
    for (int face = 0; face < kCubeFaces; ++face) {
      PutString(CubeImagePath(manifest_.At(id), face), out);
      PutString(layout_.masks ? CubeMaskPath(manifest_.At(id), face) : "", out);
      out.Put(rig).Put(static_cast<uint32_t>(face)).Put(pose);
      out.Put(place_.at(id) + static_cast<uint32_t>(face));
    }
  }
  out.Put<uint64_t>(colors_.size());
  return out.Take();
}

void CubeMvsWriter::AddPoint(const Track& track) {
  std::vector<uint32_t> views;
  for (const Observation& seen : track.observations) {
    const auto place = place_.find(seen.ref.image);
    if (place == place_.end()) continue;
    views.push_back(place->second + static_cast<uint32_t>(FaceOf(seen.bearing)));
  }
  std::ranges::sort(views);
  if (views.size() < 2) return;
  ByteWriter out;
  for (int axis = 0; axis < 3; ++axis) out.Put(static_cast<float>(track.point_in_world[axis]));
  out.Put<uint64_t>(views.size());
  for (const uint32_t view : views) out.Put(view).Put<float>(0.0F);  // no confidence is known
  file_.Append(out.Take());
  colors_.push_back(track.color);
}

absl::Status CubeMvsWriter::Finish() {
  ByteWriter out;
  out.Put<uint64_t>(0);  // normals
  out.Put<uint64_t>(colors_.size());
  for (const Rgb& color : colors_) out.Put(color.b).Put(color.g).Put(color.r);
  out.Put<uint64_t>(0).Put<uint64_t>(0).Put<uint64_t>(0);  // lines, their normals and colours
  PutRows(Eigen::Matrix4d::Identity(), out);
  file_.Append(out.Take());
  return file_.CommitWithHead(Head());
}

}  // namespace orbweave
