// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap_model.h"

#include <gmock/gmock.h>

#include "core/io/file.h"
#include "tests/core/io/io_test_support.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

TEST(ToColmapModel, ListsEveryObservationAtItsPixel) {
  const SmallScene scene = MakeSmallScene(12, 200);
  const ColmapModel model = ToColmapModel(scene.reconstruction, scene.manifest);
  ASSERT_EQ(model.cameras.size(), 2U);
  EXPECT_EQ(model.cameras[0].camera.width_px, 2048);
  ASSERT_EQ(model.images.size(), scene.reconstruction.images.size());
  EXPECT_EQ(model.images[0].image_id, 1U);
  EXPECT_EQ(model.images[0].name, "street/img0.jpg");
  ASSERT_EQ(model.points.size(), scene.reconstruction.tracks.size());
  size_t seen = 0;
  std::map<uint32_t, const ColmapImage*> images;
  for (const ColmapImage& image : model.images) images[image.image_id] = &image;
  for (size_t t = 0; t < model.points.size(); ++t) {
    const Track& track = scene.reconstruction.tracks[t];
    ASSERT_EQ(model.points[t].track.size(), track.observations.size());
    EXPECT_LT(model.points[t].error_px, 1e-6);
    for (const auto& [image_id, index] : model.points[t].track) {
      const ColmapPoint2d& point = images.at(image_id)->points2d[index];
      EXPECT_EQ(point.point3d_id, model.points[t].point3d_id);
      const EquirectangularCamera& camera = scene.manifest.images[image_id - 1].camera;
      const Eigen::Vector3d ray =
          images.at(image_id)->cam_from_world * model.points[t].point_in_world;
      EXPECT_LT(AngleBetween(camera.BearingFromPixel(point.pixel), ray), 1e-9);
      ++seen;
    }
  }
  EXPECT_EQ(seen, scene.reconstruction.NumObservations());
}

TEST(ToColmapModel, KeepsFeatureIndicesWhenItHasAllKeypoints) {
  const SmallScene scene = MakeSmallScene(8, 100);
  std::vector<std::vector<Keypoint>> keypoints(8, std::vector<Keypoint>(400));
  for (std::vector<Keypoint>& list : keypoints) {
    for (size_t i = 0; i < list.size(); ++i) list[i].x_px = static_cast<float>(i);
  }
  const ColmapModel model = ToColmapModel(scene.reconstruction, scene.manifest, keypoints);
  const Observation& first = scene.reconstruction.tracks[5].observations[0];
  EXPECT_EQ(model.points[5].track[0], std::pair(first.ref.image.value + 1, first.ref.feature));
  ASSERT_EQ(model.images[0].points2d.size(), 400U);
  EXPECT_EQ(model.images[0].points2d[7].pixel.x(), 7.0);
}

TEST(ColmapModel, RoundTripsThroughFiles) {
  const TemporaryFolder folder;
  const SmallScene scene = MakeSmallScene(12, 200);
  const ColmapModel model = ToColmapModel(scene.reconstruction, scene.manifest);
  ASSERT_TRUE(WriteColmapModel(model, folder / "sparse/0").ok());
  const absl::StatusOr<ColmapModel> read = ReadColmapModel(folder / "sparse/0");
  ASSERT_TRUE(read.ok()) << read.status();
  ASSERT_EQ(read->images.size(), model.images.size());
  for (size_t i = 0; i < model.images.size(); ++i) {
    EXPECT_EQ(read->images[i].name, model.images[i].name);
    EXPECT_EQ(read->images[i].camera_id, model.images[i].camera_id);
    EXPECT_LT(read->images[i].cam_from_world.rotation.angularDistance(
                  model.images[i].cam_from_world.rotation),
              1e-7);
    EXPECT_EQ(read->images[i].cam_from_world.translation,
              model.images[i].cam_from_world.translation);
    ASSERT_EQ(read->images[i].points2d.size(), model.images[i].points2d.size());
  }
  ASSERT_EQ(read->points.size(), model.points.size());
  EXPECT_EQ(read->points[17].track, model.points[17].track);
  EXPECT_EQ(read->points[17].point_in_world, model.points[17].point_in_world);
  EXPECT_EQ(read->points[17].color, model.points[17].color);
  EXPECT_EQ(read->cameras[1].camera, model.cameras[1].camera);
}

TEST(ReadColmapModel, RefusesEveryTruncationAndOtherCameras) {
  const TemporaryFolder folder;
  const SmallScene scene = MakeSmallScene(4, 30);
  ASSERT_TRUE(
      WriteColmapModel(ToColmapModel(scene.reconstruction, scene.manifest), folder.path()).ok());
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
  ASSERT_TRUE(
      WriteColmapModel(ToColmapModel(scene.reconstruction, scene.manifest), folder.path()).ok());
  folder.Write("points3D.bin", std::string(8, '\x7f'));
  EXPECT_EQ(ReadColmapModel(folder.path()).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace orbweave
