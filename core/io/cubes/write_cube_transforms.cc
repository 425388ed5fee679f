// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/cubes/write_cube_transforms.h"

#include "core/io/file.h"
#include "core/io/json_text.h"

namespace orbweave {
namespace {

Json MatrixJson(const Rigid3& face_from_world) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  const Eigen::Vector3d to_opengl(1.0, -1.0, -1.0);
  matrix.topLeftCorner<3, 3>() =
      face_from_world.rotation.toRotationMatrix().transpose() * to_opengl.asDiagonal();
  matrix.topRightCorner<3, 1>() = face_from_world.Centre();
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
  }
  return rows;
}

Json FrameJson(const ImageRecord& record,
               const Rigid3& cam_from_world,
               const CubeLayout& layout,
               int face) {
  const PinholeFace pinhole = layout.FaceOf(record.camera);
  Json frame;
  frame["file_path"] = CubeImagePath(record, face);
  if (layout.masks) frame["mask_path"] = CubeMaskPath(record, face);
  frame["w"] = pinhole.size_px;
  frame["h"] = pinhole.size_px;
  frame["fl_x"] = pinhole.Focal_px();
  frame["fl_y"] = pinhole.Focal_px();
  frame["cx"] = pinhole.Principal_px();
  frame["cy"] = pinhole.Principal_px();
  frame["transform_matrix"] = MatrixJson(FaceFromWorld(face, cam_from_world));
  return frame;
}

}  // namespace

absl::Status WriteCubeTransforms(const std::string& path,
                                 const std::map<ImageId, RegisteredImage>& images,
                                 const ImageManifest& manifest,
                                 const CubeLayout& layout) {
  AtomicFile file(path);
  file.Append("{\"camera_model\": \"OPENCV\", \"k1\": 0, \"k2\": 0, \"p1\": 0, \"p2\": 0,\n");
  file.Append("\"frames\": [\n");
  bool first = true;
  for (const auto& [id, image] : images) {
    for (int face = 0; face < kCubeFaces; ++face) {
      if (!first) file.Append(",");
      first = false;
      file.Append(JsonText(FrameJson(manifest.At(id), image.cam_from_world, layout, face), -1));
    }
  }
  file.Append("]}\n");
  return file.Commit();
}

}  // namespace orbweave
