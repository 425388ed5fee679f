// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/io/cubes/cube_layout.h"
#include "core/io/file.h"

namespace orbweave {

/// Writes a sparse model of panoramas as COLMAP stores one of pinhole images: cameras.bin (PINHOLE:
/// f, f, cx, cy), images.bin, points3D.bin, and rigs.bin and frames.bin for COLMAP >= 3.12, which
/// older ones do not look for. Poses are those of equation (12), each observation lies on the face
/// it falls on. A rig per size of faces; camera 6 rig + face + 1, image 6 ImageId + face + 1, frame
/// ImageId + 1. Points come one by one; in memory stay 24 bytes an observation. Points that fewer
/// than two of the images see are left out.
class CubeColmapWriter {
 public:
  /// `folder` exists; `images` and `manifest` outlive the object.
  CubeColmapWriter(const std::string& folder,
                   const std::map<ImageId, RegisteredImage>& images,
                   const ImageManifest& manifest,
                   const CubeLayout& layout);

  void AddPoint(const Track& track);
  /// The five files take their places. Codes of WriteFileAtomically.
  [[nodiscard]] absl::Status Finish();

 private:
  struct SeenPoint {
    Eigen::Vector2d pixel;
    uint64_t point;
  };
  using Faces = std::array<std::vector<SeenPoint>, kCubeFaces>;

  [[nodiscard]] uint32_t RigOf(ImageId id) const;
  [[nodiscard]] std::string CamerasBin() const;
  [[nodiscard]] std::string RigsBin() const;
  [[nodiscard]] std::string FramesBin() const;
  [[nodiscard]] absl::Status WriteImages() const;

  std::string folder_;
  const std::map<ImageId, RegisteredImage>& images_;
  const ImageManifest& manifest_;
  CubeLayout layout_;
  std::vector<PinholeFace> rigs_;
  std::map<ImageId, Faces> seen_{};
  uint64_t num_points_ = 0;
  AtomicFile points_file_;
};

}  // namespace orbweave
