// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "core/geometry/cube_face.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// How panoramas become six pinhole images each, alike for all programs they are written for: the
/// faces of cube_face.h as images/FACE/PANORAMA, masks as masks/FACE/PANORAMA.png (black: ignored).
struct CubeLayout {
  /// Of a face; 0: as many as keep the resolution of the panorama in its middle, W / pi.
  int size_px = 0;
  bool masks = false;  ///< whether all panoramas have one

  [[nodiscard]] PinholeFace FaceOf(const EquirectangularCamera& camera) const;
};

/// "front", "right", "back", "left", "up", "down".
[[nodiscard]] std::string_view CubeFaceName(int face);

/// "front/drive/0001.jpg": what is no JPEG gets ".jpg" behind its name.
[[nodiscard]] std::string CubeImageName(const ImageRecord& record, int face);
/// Relative to the folder of the export.
[[nodiscard]] std::string CubeImagePath(const ImageRecord& record, int face);
[[nodiscard]] std::string CubeMaskPath(const ImageRecord& record, int face);

/// InvalidArgument: an image's name, as a database may give it, leads out of the folder.
[[nodiscard]] absl::Status CheckCubeNames(const std::map<ImageId, RegisteredImage>& images,
                                          const ImageManifest& manifest);

/// The different faces of a model, in order of first use: one rig each.
[[nodiscard]] std::vector<PinholeFace> CubeRigs(const std::map<ImageId, RegisteredImage>& images,
                                                const ImageManifest& manifest,
                                                const CubeLayout& layout);

/// A bearing as the face it falls on sees it.
struct CubeObservation {
  int face = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

[[nodiscard]] CubeObservation ObserveOnCube(const Eigen::Vector3d& bearing, PinholeFace pinhole);

}  // namespace orbweave
