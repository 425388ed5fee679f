// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"
#include "tests/core/pictures/encoded_images.h"

namespace orbweave {

/// A folder of its own for one test, removed afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "orbweave_io_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string operator/(std::string_view name) const {
    return path_ + "/" + std::string(name);
  }
  void Write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path file = *this / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
  }

 private:
  std::string path_;
};

/// A small noisy image, encoded as `extension` (".jpg", ".png", ...); different seeds give
/// different bytes.
inline std::string EncodedImage(int width_px,
                                int height_px,
                                const std::string& extension,
                                uint64_t seed = 1) {
  cv::Mat image(height_px, width_px, CV_8UC3);
  Random random(seed);
  for (int i = 0; i < image.rows * image.cols * 3; ++i)
    image.data[i] = static_cast<uint8_t>(random.Index(256));
  return Encoded(image, extension);
}

/// Cameras on a street of two panorama sizes that see `num_points` points, each in every third
/// camera about; bearings are exact. Camera 1 of every ten is not registered.
struct SmallScene {
  ImageManifest manifest{};
  Reconstruction reconstruction{};
};

inline SmallScene MakeSmallScene(uint32_t num_images, size_t num_points) {
  SmallScene scene;
  Random random(3);
  for (uint32_t i = 0; i < num_images; ++i) {
    ImageRecord record;
    record.id = ImageId(i);
    record.name = "street/img" + std::to_string(i) + ".jpg";
    record.camera =
        i % 3 == 2 ? EquirectangularCamera{1024, 512} : EquirectangularCamera{2048, 1024};
    scene.manifest.images.push_back(record);
    if (i % 10 == 1) continue;
    const Eigen::Vector3d turn(
        0.2 * random.Normal(), random.Uniform(-3.0, 3.0), 0.2 * random.Normal());
    scene.reconstruction.images[record.id].cam_from_world = Rigid3::FromCentre(
        RotationFromVector(turn), Eigen::Vector3d(3.0 * i, random.Normal(), 0.1 * random.Normal()));
  }
  std::vector<FeatureIndex> next_feature(num_images, 0);
  for (size_t p = 0; p < num_points; ++p) {
    Track track;
    track.point_in_world = {random.Uniform(-5.0, 3.0 * num_images + 5.0),
                            random.Uniform(-15.0, 15.0),
                            random.Uniform(-2.0, 8.0)};
    track.color = {static_cast<uint8_t>(p % 256), 20, 30};
    for (const auto& [id, image] : scene.reconstruction.images) {
      if (random.Index(3) != 0) continue;
      Observation observation;
      observation.ref = {id, next_feature[id.value]};
      next_feature[id.value] += 2;  // every other feature has no track
      observation.bearing = (image.cam_from_world * track.point_in_world).normalized();
      track.observations.push_back(observation);
    }
    if (track.observations.size() >= 2) scene.reconstruction.tracks.push_back(track);
  }
  scene.reconstruction.SortTracks();
  return scene;
}

}  // namespace orbweave
