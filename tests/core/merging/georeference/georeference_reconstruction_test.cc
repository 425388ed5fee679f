// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/georeference_reconstruction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/rotation.h"
#include "core/merging/georeference/find_gravity.h"
#include "core/merging/georeference/georeference.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using testing::RandomDirection;
using testing::RandomRotation;

struct GnssWorld {
  Reconstruction model{};
  ImageManifest manifest{};
};

// Panoramas at `centres` (east-north-up), upright within 3 degrees and with any heading.
GnssWorld MakeGnssWorld(const std::vector<Eigen::Vector3d>& centres,
                        double sigma_m,
                        Random& random) {
  GnssWorld world;
  const Eigen::Quaterniond level =
      RotationFromVector({0.5 * EIGEN_PI, 0.0, 0.0});  // y down, z north
  for (uint32_t i = 0; i < centres.size(); ++i) {
    const Eigen::Quaterniond tilt = RotationFromVector(0.05 * RandomDirection(random));
    const Eigen::Quaterniond heading = RotationFromVector({0.0, 0.0, random.Uniform(-3.0, 3.0)});
    world.model.images[ImageId(i)].cam_from_world =
        Rigid3::FromCentre(tilt * level * heading, centres[i]);
    ImageRecord& image = world.manifest.images.emplace_back();
    image.id = ImageId(i);
    const double x = random.Normal();
    const double y = random.Normal();
    image.prior.position_in_enu =
        centres[i] + sigma_m * Eigen::Vector3d(x, y, 2.0 * random.Normal());
    image.prior.horizontal_sigma_m = std::max(sigma_m, 1.0);
    image.prior.vertical_sigma_m = 2.0 * image.prior.horizontal_sigma_m;
  }
  return world;
}

std::vector<Eigen::Vector3d> StraightStreet(int n, double spacing_m) {
  std::vector<Eigen::Vector3d> centres;
  for (int i = 0; i < n; ++i) centres.emplace_back(0.6 * spacing_m * i, 0.8 * spacing_m * i, 1.0);
  return centres;
}

std::vector<Eigen::Vector3d> Room(int n, double size_m, Random& random) {
  std::vector<Eigen::Vector3d> centres;
  for (int i = 0; i < n; ++i) {
    const double x = random.Uniform(0.0, size_m);
    centres.emplace_back(x, random.Uniform(0.0, size_m), 1.5);
  }
  return centres;
}

Sim3 SomeFrame(Random& random) {
  return {2.5, RandomRotation(random), 30.0 * RandomDirection(random)};
}

Georeference Georeferenced(const GnssWorld& world) {
  auto result = GeoreferenceReconstruction(world.model, world.manifest, GnssUse::kAuto, {});
  EXPECT_TRUE(result.ok()) << result.status();
  return result.value_or(Georeference{});
}

TEST(FindGravity, FindsDownAmidTiltedAndSomeUpturnedPanoramas) {
  Random random(1);
  GnssWorld world = MakeGnssWorld(StraightStreet(40, 3.0), 1.0, random);
  for (const uint32_t i : {3U, 9U}) {
    Rigid3& pose = world.model.images.at(ImageId(i)).cam_from_world;
    pose.rotation = RotationFromVector({3.0, 0.0, 0.0}) * pose.rotation;
  }
  const auto down = FindGravity(world.model);
  ASSERT_TRUE(down.has_value());
  EXPECT_LT(AngleBetween(*down, -Eigen::Vector3d::UnitZ()), 0.02);
  EXPECT_LT(((UprightFromDown(*down) * *down) + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(FindGravity, IsSilentAboutPanoramasTurnedAtRandom) {
  Random random(2);
  GnssWorld world = MakeGnssWorld(StraightStreet(40, 3.0), 1.0, random);
  for (auto& [id, image] : world.model.images)
    image.cam_from_world.rotation = RandomRotation(random);
  EXPECT_FALSE(FindGravity(world.model).has_value());
  EXPECT_FALSE(FindGravity({}).has_value());
}

TEST(GeoreferenceReconstruction, UndoesTheFrameOfAStraightStreet) {
  Random random(3);
  GnssWorld world = MakeGnssWorld(StraightStreet(60, 3.0), 0.0, random);
  const Reconstruction truth = world.model;
  world.model = Transformed(SomeFrame(random), std::move(world.model));
  const Georeference result = Georeferenced(world);
  ASSERT_TRUE(result.enu_from_world.has_value()) << result.reason;
  const Reconstruction found = Transformed(*result.enu_from_world, world.model);
  for (const auto& [id, image] : found.images) {
    const Rigid3& expected = truth.images.at(id).cam_from_world;
    // Gravity pulls the scale by the square of its error: 3e-4 of 180 m.
    EXPECT_LT((image.cam_from_world.Centre() - expected.Centre()).norm(), 0.05);
    // The roll is as good as the mean tilt of the panoramas.
    EXPECT_LT(RotationAngle(image.cam_from_world.rotation * expected.rotation.conjugate()), 0.03);
  }
}

TEST(GeoreferenceReconstruction, SeesThroughOutliers) {
  Random random(4);
  GnssWorld world = MakeGnssWorld(StraightStreet(60, 3.0), 1.0, random);
  for (uint32_t i = 0; i < 12; ++i) {
    *world.manifest.images[5 * i].prior.position_in_enu += 80.0 * RandomDirection(random);
  }
  const Reconstruction truth = world.model;
  world.model = Transformed(SomeFrame(random), std::move(world.model));
  const Georeference result = Georeferenced(world);
  ASSERT_TRUE(result.enu_from_world.has_value()) << result.reason;
  EXPECT_LT(result.horizontal_scatter_m, 2.0);
  const Reconstruction found = Transformed(*result.enu_from_world, world.model);
  for (const auto& [id, image] : found.images) {
    EXPECT_LT((image.cam_from_world.Centre() - truth.images.at(id).cam_from_world.Centre()).norm(),
              2.5);
  }
}

// Of a street of 40 panoramas the last `num_elsewhere` are a third as far apart as they are.
GnssWorld Shrunken(int num_elsewhere, Random& random) {
  std::vector<Eigen::Vector3d> street = StraightStreet(40, 8.0);
  for (size_t i = 20; i < street.size(); ++i) street[i].y() = street[19].y();
  GnssWorld world = MakeGnssWorld(street, 2.0, random);
  const Eigen::Vector3d& joint = street[static_cast<size_t>(39 - num_elsewhere)];
  for (size_t i = static_cast<size_t>(40 - num_elsewhere); i < street.size(); ++i) {
    Rigid3& pose = world.model.images.at(ImageId(static_cast<uint32_t>(i))).cam_from_world;
    pose = Rigid3::FromCentre(pose.rotation, joint + (street[i] - joint) / 3.0);
  }
  return world;
}

TEST(GeoreferenceReconstruction, PlacesAModelOfWhichAPartIsElsewhereAndDoubtsIt) {
  for (const uint64_t seed : {1U, 2U, 3U}) {
    Random random(seed);
    GnssWorld world = Shrunken(16, random);
    const Eigen::Vector3d first = world.model.images.at(ImageId(0)).cam_from_world.Centre();
    world.model = Transformed(SomeFrame(random), std::move(world.model));
    const Georeference result = Georeferenced(world);
    ASSERT_TRUE(result.enu_from_world.has_value()) << result.reason;
    const Reconstruction found = Transformed(*result.enu_from_world, world.model);
    EXPECT_LT((found.images.at(ImageId(0)).cam_from_world.Centre() - first).norm(), 5.0) << seed;
    const auto check = std::ranges::find(result.checks, "gnss_agreement", &CrossCheck::name);
    ASSERT_NE(check, result.checks.end());
    EXPECT_EQ(check->level, CheckLevel::kDoubtful);
    EXPECT_FALSE(check->IsWithinLimit());
    EXPECT_THAT(check->sentence, HasSubstr("% of the GNSS positions agree"));
  }
}

TEST(GeoreferenceReconstruction, TakesAHandfulThatAgreesAsWellAsItStates) {
  Random random(8);
  GnssWorld world = MakeGnssWorld(StraightStreet(8, 9.0), 0.0, random);
  for (ImageRecord& image : world.manifest.images) image.prior.horizontal_sigma_m = 5.0;
  // Half are exact, so that the scatter is; of the others one is wrong.
  for (const uint32_t i : {1U, 4U, 6U})
    world.manifest.images[i].prior.position_in_enu->head<2>() += Eigen::Vector2d(4.0, 3.0);
  world.manifest.images[3].prior.position_in_enu->x() += 36.0;
  world.model = Transformed(SomeFrame(random), std::move(world.model));
  const Georeference result = Georeferenced(world);
  EXPECT_TRUE(result.enu_from_world.has_value()) << result.reason;
  EXPECT_TRUE(std::ranges::none_of(
      result.checks, [](const CrossCheck& check) { return check.name == "gnss_agreement"; }));
}

TEST(GeoreferenceReconstruction, TakesNoHandfulThatAgreesByChance) {
  int refused = 0;
  for (uint64_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    GnssWorld world = MakeGnssWorld(Room(7, 60.0, random), 1.0, random);
    for (uint32_t i = 4; i < 7; ++i)
      *world.manifest.images[i].prior.position_in_enu += 40.0 * RandomDirection(random);
    const Georeference result = Georeferenced(world);
    refused += result.enu_from_world ? 0 : 1;
    for (const CrossCheck& check : result.checks) EXPECT_NE(check.name, "gnss_agreement") << seed;
  }
  EXPECT_GE(refused, 20);
}

TEST(GeoreferenceReconstruction, RefusesAScaleFromAPhoneIndoors) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    GnssWorld world = MakeGnssWorld(Room(11, 6.0, random), 10.0, random);
    world.model = Transformed(SomeFrame(random), std::move(world.model));
    const Georeference result = Georeferenced(world);
    EXPECT_FALSE(result.enu_from_world.has_value()) << seed;
    EXPECT_FALSE(result.reason.empty());
  }
}

TEST(GeoreferenceReconstruction, TellsPicturesThatAreMirrored) {
  for (const uint64_t seed : {1U, 2U, 3U}) {
    Random random(seed);
    std::vector<Eigen::Vector3d> bend = StraightStreet(60, 3.0);
    for (size_t i = 30; i < bend.size(); ++i) bend[i].y() = bend[30].y();
    GnssWorld world = MakeGnssWorld(bend, 1.0, random);
    EXPECT_TRUE(Georeferenced(world).checks.empty()) << "nothing is wrong with it";
    for (ImageRecord& image : world.manifest.images)  // as of a table that states north and east
      std::swap(image.prior.position_in_enu->x(), image.prior.position_in_enu->y());
    world.model = Transformed(SomeFrame(random), std::move(world.model));
    const Georeference result = Georeferenced(world);
    EXPECT_FALSE(result.enu_from_world);
    ASSERT_EQ(result.checks.size(), 1U);
    EXPECT_EQ(result.checks[0].name, "gnss_mirrored");
    EXPECT_EQ(result.checks[0].level, CheckLevel::kBad);
  }
}

TEST(GeoreferenceReconstruction, SaysWhyItCannot) {
  Random random(5);
  GnssWorld few = MakeGnssWorld(StraightStreet(3, 3.0), 1.0, random);
  EXPECT_THAT(Georeferenced(few).reason, HasSubstr("3 images"));
  GnssWorld still = MakeGnssWorld(std::vector<Eigen::Vector3d>(10, {1, 2, 3}), 1.0, random);
  EXPECT_FALSE(Georeferenced(still).enu_from_world.has_value());
  EXPECT_FALSE(Georeferenced(still).reason.empty());
}

}  // namespace
}  // namespace orbweave
