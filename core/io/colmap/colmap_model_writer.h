// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "core/io/file.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// Writes a sparse model as COLMAP stores it, cameras.bin, images.bin and points3D.bin
/// (EQUIRECTANGULAR, model id 17, parameters width and height), point by point and then image by
/// image: what stays in memory is which point each observed feature belongs to, 16 bytes an
/// observation. One camera per image size (ids from 1, in order of first use), image_id = ImageId +
/// 1, point ids count from 1 in the order of points, points2d are all features of an image.
class ColmapModelWriter {
 public:
  /// `images` are all of the model's; `folder` exists; `images` and `manifest` outlive the object.
  ColmapModelWriter(const std::string& folder,
                    const std::map<ImageId, RegisteredImage>& images,
                    const ImageManifest& manifest);

  void AddPoint(const Track& track);
  /// After all points; every image once, in ascending order.
  void AddImage(ImageId id, const std::vector<Keypoint>& keypoints);
  /// The three files take their places. Codes of WriteFileAtomically.
  [[nodiscard]] absl::Status Finish();

 private:
  [[nodiscard]] uint32_t CameraIdOf(const EquirectangularCamera& camera);

  const std::map<ImageId, RegisteredImage>& images_;
  const ImageManifest& manifest_;
  std::vector<EquirectangularCamera> cameras_;
  std::map<ImageId, std::vector<std::pair<FeatureIndex, uint64_t>>> point_of_feature_;
  uint64_t num_points_ = 0;
  std::string cameras_path_;
  AtomicFile images_file_;
  AtomicFile points_file_;
};

}  // namespace orbweave
