// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap/colmap_model.h"

#include <gmock/gmock.h>

#include "core/io/colmap/colmap_model_writer.h"
#include "core/io/file.h"
#include "tests/core/io/io_test_support.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

/// All features of every image; those that no track has are at (feature, image).
std::vector<std::vector<Keypoint>> KeypointsOf(const SmallScene& scene) {
  std::vector<std::vector<Keypoint>> keypoints(scene.manifest.images.size(),
                                               std::vector<Keypoint>(400));
  for (size_t i = 0; i < keypoints.size(); ++i) {
    for (size_t f = 0; f < keypoints[i].size(); ++f) {
      keypoints[i][f].x_px = static_cast<float>(f);
      keypoints[i][f].y_px = static_cast<float>(i);
    }
  }
  for (const Track& track : scene.reconstruction.tracks) {
    for (const Observation& seen : track.observations) {
      const Eigen::Vector2d pixel =
          scene.manifest.At(seen.ref.image).camera.PixelFromBearing(seen.bearing);
      Keypoint& keypoint = keypoints[seen.ref.image.value][seen.ref.feature];
      keypoint.x_px = static_cast<float>(pixel.x());
      keypoint.y_px = static_cast<float>(pixel.y());
    }
  }
  return keypoints;
}

void Write(const SmallScene& scene, const std::string& folder) {
  std::filesystem::create_directories(folder);
  const std::vector<std::vector<Keypoint>> keypoints = KeypointsOf(scene);
  ColmapModelWriter writer(folder, scene.reconstruction.images, scene.manifest);
  for (const Track& track : scene.reconstruction.tracks) writer.AddPoint(track);
  for (const auto& [id, image] : scene.reconstruction.images)
    writer.AddImage(id, keypoints[id.value]);
  EXPECT_TRUE(writer.Finish().ok());
}

ColmapModel WrittenAndRead(const SmallScene& scene) {
  const TemporaryFolder folder;
  Write(scene, folder / "sparse/0");
  absl::StatusOr<ColmapModel> model = ReadColmapModel(folder / "sparse/0");
  EXPECT_TRUE(model.ok()) << model.status();
  return std::move(model).value_or(ColmapModel{});
}

TEST(ColmapModelWriter, ListsEveryObservationAtItsPixel) {
  const SmallScene scene = MakeSmallScene(12, 200);
  const ColmapModel model = WrittenAndRead(scene);
  ASSERT_EQ(model.cameras.size(), 2U);
  EXPECT_EQ(model.cameras[0].camera.width_px, 2048);
  EXPECT_EQ(model.cameras[1].camera.width_px, 1024);
  ASSERT_EQ(model.points.size(), scene.reconstruction.tracks.size());
  size_t seen = 0;
  std::map<uint32_t, const ColmapImage*> images;
  for (const ColmapImage& image : model.images) images[image.image_id] = &image;
  for (size_t t = 0; t < model.points.size(); ++t) {
    const Track& track = scene.reconstruction.tracks[t];
    EXPECT_EQ(model.points[t].point_in_world, track.point_in_world);
    EXPECT_EQ(model.points[t].color, track.color);
    ASSERT_EQ(model.points[t].track.size(), track.observations.size());
    EXPECT_LT(model.points[t].error_px, 1e-6);
    for (const auto& [image_id, index] : model.points[t].track) {
      const ColmapPoint2d& point = images.at(image_id)->points2d[index];
      EXPECT_EQ(point.point3d_id, model.points[t].point3d_id);
      const EquirectangularCamera& camera = scene.manifest.images[image_id - 1].camera;
      const Eigen::Vector3d ray =
          images.at(image_id)->cam_from_world * model.points[t].point_in_world;
      EXPECT_LT(AngleBetween(camera.BearingFromPixel(point.pixel), ray), 1e-6);
      ++seen;
    }
  }
  EXPECT_EQ(seen, scene.reconstruction.NumObservations());
}

TEST(ColmapModelWriter, KeepsPosesNamesAndFeaturesWithoutPoints) {
  const SmallScene scene = MakeSmallScene(12, 200);
  const ColmapModel model = WrittenAndRead(scene);
  ASSERT_EQ(model.images.size(), scene.reconstruction.images.size());
  for (const ColmapImage& image : model.images) {
    const ImageId id(image.image_id - 1);
    const Rigid3& pose = scene.reconstruction.images.at(id).cam_from_world;
    EXPECT_EQ(image.name, scene.manifest.At(id).name);
    EXPECT_EQ(model.cameras[image.camera_id - 1].camera, scene.manifest.At(id).camera);
    EXPECT_LT(image.cam_from_world.rotation.angularDistance(pose.rotation), 1e-7);
    EXPECT_EQ(image.cam_from_world.translation, pose.translation);
    ASSERT_EQ(image.points2d.size(), 400U);
    EXPECT_EQ(image.points2d[399].point3d_id, kNoColmapPoint);
    EXPECT_EQ(image.points2d[399].pixel, Eigen::Vector2d(399.0, id.value));
  }
}

TEST(ColmapModelWriter, LeavesTheOldModelWhenItIsNotFinished) {
  const TemporaryFolder folder;
  const SmallScene scene = MakeSmallScene(4, 30);
  Write(scene, folder.path());
  const std::string before = ReadFile(folder / "points3D.bin").value();
  { const ColmapModelWriter abandoned(folder.path(), scene.reconstruction.images, scene.manifest); }
  EXPECT_EQ(ReadFile(folder / "points3D.bin").value(), before);
  size_t files = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
    EXPECT_EQ(file.path().extension(), ".bin");
    ++files;
  }
  EXPECT_EQ(files, 3U);
}

TEST(ReadColmapModel, RefusesEveryTruncationAndOtherCameras) {
  const TemporaryFolder folder;
  const SmallScene scene = MakeSmallScene(4, 30);
  Write(scene, folder.path());
  for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) {
    const std::string bytes = ReadFile(folder / name).value();
    for (size_t size = 0; size < bytes.size(); size += 1 + size / 10) {
      folder.Write(name, bytes.substr(0, size));
      EXPECT_EQ(ReadColmapModel(folder.path()).status().code(), absl::StatusCode::kInvalidArgument)
          << name << " " << size;
    }
    folder.Write(name, bytes);
  }
  std::string cameras = ReadFile(folder / "cameras.bin").value();
  cameras[12] = 1;
  folder.Write("cameras.bin", cameras);
  EXPECT_THAT(ReadColmapModel(folder.path()).status().message(), HasSubstr("camera 1 has model 1"));
  std::filesystem::remove(folder / "cameras.bin");
  EXPECT_EQ(ReadColmapModel(folder.path()).status().code(), absl::StatusCode::kNotFound);
}

TEST(ReadColmapModel, RefusesHugeCountsWithoutAllocating) {
  const TemporaryFolder folder;
  const SmallScene scene = MakeSmallScene(4, 30);
  Write(scene, folder.path());
  folder.Write("points3D.bin", std::string(8, '\x7f'));
  EXPECT_EQ(ReadColmapModel(folder.path()).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace orbweave
