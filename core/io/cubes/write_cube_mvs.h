// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/io/cubes/cube_layout.h"
#include "core/io/file.h"

namespace orbweave {

/// Writes a sparse model of panoramas as OpenMVS reads one of pinhole images (its interface archive
/// "MVSI", version 5, libs/MVS/Interface.h): a platform of six cameras per size of faces, a pose
/// per panorama, all images with paths relative to the file, and points with the faces that see
/// them. The middle of the first pixel is (0, 0) there, so principal points are (size - 1) / 2.
/// Points come one by one; in memory stay 3 bytes a point. Points that fewer than two faces see are
/// left out.
class CubeMvsWriter {
 public:
  /// `images` and `manifest` outlive the object.
  CubeMvsWriter(std::string path,
                const std::map<ImageId, RegisteredImage>& images,
                const ImageManifest& manifest,
                const CubeLayout& layout);

  void AddPoint(const Track& track);
  /// The file takes its place. Codes of WriteFileAtomically.
  [[nodiscard]] absl::Status Finish();

 private:
  /// Everything before the first point.
  [[nodiscard]] std::string Head() const;

  const std::map<ImageId, RegisteredImage>& images_;
  const ImageManifest& manifest_;
  CubeLayout layout_;
  std::map<ImageId, uint32_t> place_{};  ///< of an image among all
  std::vector<Rgb> colors_{};
  AtomicFile file_;
};

}  // namespace orbweave
