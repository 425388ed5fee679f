// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "core/io/cubes/cube_layout.h"
#include "core/io/cubes/write_cube_colmap.h"
#include "core/io/cubes/write_cube_mvs.h"

namespace orbweave {

struct CubeExportOptions {
  int size_px = 0;  ///< of a face; 0: W / pi
  bool colmap = true;
  bool nerfstudio = true;
  bool openmvs = true;
  int num_threads = 1;  ///< each with a panorama in memory
};

/// The encoded file of a panorama, or of its mask. Empty: there is none, nothing is written for it.
using EncodedFileOf = std::function<absl::StatusOr<std::string>(const ImageRecord&)>;

struct CubeExportCounts {
  size_t panoramas = 0;
  size_t without_pixels = 0;  ///< poses of theirs are written, images are not
};

/// Writes a model of panoramas as pinhole images, six of 90 degrees each, for programs that know
/// no panoramas: images/, masks/, sparse/0 (COLMAP), transforms.json (nerfstudio), scene.mvs
/// (OpenMVS). Points come one by one; loose images, which nothing but a position places, take no
/// part. Files of an earlier export of more images stay.
class CubeExport {
 public:
  /// `images` and `manifest` outlive the object.
  CubeExport(std::string folder,
             const std::map<ImageId, RegisteredImage>& images,
             const ImageManifest& manifest,
             const CubeExportOptions& options);

  /// Makes the folders. InvalidArgument: as of CheckCubeNames; codes of EnsureWritableFolder.
  [[nodiscard]] absl::Status Begin();
  void AddPoint(const Track& track);
  /// Codes of WriteFileAtomically, of EncodeCubeFaces with the image's name, and of the functions.
  [[nodiscard]] absl::StatusOr<CubeExportCounts> Finish(const EncodedFileOf& panorama_of,
                                                        const EncodedFileOf& mask_of);

 private:
  [[nodiscard]] absl::StatusOr<bool> WriteImages(const ImageRecord& record,
                                                 const EncodedFileOf& panorama_of,
                                                 const EncodedFileOf& mask_of) const;

  std::string folder_;
  const ImageManifest& manifest_;
  CubeExportOptions options_;
  CubeLayout layout_;
  std::map<ImageId, RegisteredImage> images_;  ///< none loose
  std::unique_ptr<CubeColmapWriter> colmap_{};
  std::unique_ptr<CubeMvsWriter> mvs_{};
};

/// All of it for a reconstruction in memory.
[[nodiscard]] absl::StatusOr<CubeExportCounts> ExportCubeFaces(const std::string& folder,
                                                               const Reconstruction& reconstruction,
                                                               const ImageManifest& manifest,
                                                               const CubeExportOptions& options,
                                                               const EncodedFileOf& panorama_of,
                                                               const EncodedFileOf& mask_of);

}  // namespace orbweave
