// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/model_from_colmap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ImageManifest ManifestOf(const std::vector<std::string>& names) {
  ImageManifest manifest;
  for (const std::string& name : names) {
    const auto id = static_cast<uint32_t>(manifest.images.size());
    manifest.images.push_back(
        {.id = ImageId(id), .name = name, .content = DigestOf(name), .camera = {256, 128}});
  }
  return manifest;
}

/// Images in a row.
ColmapModel ModelOf(const std::vector<std::string>& names) {
  ColmapModel model{.cameras = {{.camera_id = 1, .camera = {256, 128}}}};
  for (const std::string& name : names) {
    const auto id = static_cast<uint32_t>(model.images.size() + 1);
    model.images.push_back({.image_id = id,
                            .camera_id = 1,
                            .name = name,
                            .cam_from_world = Rigid3::FromCentre(Eigen::Quaterniond::Identity(),
                                                                 {1.0 * id, 0.0, 0.0})});
  }
  return model;
}

TEST(ModelFromColmap, LeavesOutPosesThatAreNoNumbersAndPointsSeenByThem) {
  ColmapModel model = ModelOf({"a.jpg", "b.jpg", "c.jpg"});
  model.images[1].cam_from_world.translation.y() = kNaN;
  const ColmapPoint3d point{.point_in_world = {2.0, 3.0, 1.0}, .track = {{1, 0}, {2, 0}}};
  model.points = {point, point, point};
  model.points[1].track = {{1, 0}, {3, 0}};
  model.points[2].track = {{1, 0}, {3, 0}};
  model.points[2].point_in_world.x() = kNaN;
  const auto imported = ModelFromColmap(model, ManifestOf({"a.jpg", "b.jpg", "c.jpg"}));
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->world.images.size(), 2U);
  EXPECT_FALSE(imported->world.images.contains(ImageId(1)));
  ASSERT_EQ(imported->subproblems.size(), 1U);
  EXPECT_EQ(imported->subproblems[0].scene.tracks.size(), 1U);
}

TEST(ModelFromColmap, GoesOnWithoutImagesThatAreNotThereAndNamesThem) {
  const auto imported = ModelFromColmap(ModelOf({"a.jpg", "b.jpg", "c.jpg"}),
                                        ManifestOf({"a.jpg", "c.jpg", "d.jpg"}));
  ASSERT_TRUE(imported.ok()) << imported.status();
  EXPECT_EQ(imported->world.images.size(), 2U);
  ASSERT_EQ(imported->without_image.size(), 1U);
  EXPECT_EQ(imported->without_image[0].name, "b.jpg");
}

TEST(ModelFromColmap, RefusesAModelOfOtherNamesAndSaysBoth) {
  const auto imported = ModelFromColmap(ModelOf({"a.jpg"}), ManifestOf({"holiday.jpg"}));
  EXPECT_EQ(imported.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(imported.status().message()), HasSubstr("a.jpg"));
  EXPECT_THAT(std::string(imported.status().message()), HasSubstr("holiday.jpg"));
}

}  // namespace
}  // namespace orbweave
