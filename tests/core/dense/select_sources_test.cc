// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/select_sources.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// A camera every 2.5 m along x, each turned its own way, between two facades and over a road.
struct Street {
  std::map<ImageId, RegisteredImage> images{};
  std::vector<Track> tracks{};
  std::vector<ImageId> all{};

  explicit Street(uint32_t count, double spacing_m = 2.5) {
    Random random(3);
    for (uint32_t i = 0; i < count; ++i) {
      const Vector3d turn(random.Normal(), random.Normal(), random.Normal());
      images[ImageId(i)].cam_from_world =
          Rigid3::FromCentre(RotationFromVector(turn), {spacing_m * i, 0.0, 0.0});
      all.push_back(ImageId(i));
    }
    for (int p = 0; p < 2000; ++p) AddPoint(random, spacing_m * (count - 1));
  }

  void AddPoint(Random& random, double length_m) {
    const double along = random.Uniform(-5.0, length_m + 5.0);
    const Vector3d points[] = {{along, 6.0, random.Uniform(-2.0, 6.0)},
                               {along, -7.0, random.Uniform(-2.0, 6.0)},
                               {along, random.Uniform(-5.0, 5.0), -2.5}};
    Track track{.point_in_world = points[random.Index(3)]};
    for (const auto& [id, image] : images) {
      const Vector3d in_cam = image.cam_from_world * track.point_in_world;
      if (in_cam.norm() < 15.0) track.observations.push_back({{id, 0}, in_cam.normalized()});
    }
    if (track.observations.size() > 1) tracks.push_back(track);
  }
};

std::vector<SourceChoice> Select(const Street& street, const SourceOptions& options = {}) {
  return SelectSources(street.images, street.all, street.tracks, options);
}

TEST(SelectSources, TakesNeighboursOnBothSidesAndNeverItself) {
  const Street street(12);
  const std::vector<SourceChoice> choices = Select(street);
  ASSERT_EQ(choices.size(), 12U);
  const SourceChoice& middle = choices[6];
  EXPECT_TRUE(middle.problem.empty());
  EXPECT_GE(middle.sources.size(), 4U);
  EXPECT_LE(middle.sources.size(), 8U);
  int before = 0;
  int after = 0;
  for (const ImageId source : middle.sources) {
    ASSERT_NE(source.value, 6U);
    EXPECT_LE(std::abs(static_cast<int>(source.value) - 6), 5);
    ++(source.value < 6 ? before : after);
  }
  EXPECT_GE(before, 2);
  EXPECT_GE(after, 2);
}

TEST(SelectSources, IsTheSameWhicheverWayTheStreetIsTurned) {
  const Street street(10);
  const Sim3 turn{2.0, Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized(), {40.0, -7.0, 3.0}};
  const Reconstruction turned =
      Transformed(turn, Reconstruction{.images = street.images, .tracks = street.tracks});
  const auto choices = Select(street);
  const auto same = SelectSources(turned.images, street.all, turned.tracks, {});
  for (size_t i = 0; i < choices.size(); ++i) {
    EXPECT_EQ(choices[i].sources, same[i].sources);
    EXPECT_NEAR(2.0 * choices[i].max_range_m, same[i].max_range_m, 1e-9);
  }
}

TEST(SelectSources, HasSeedsWhereThePointsAre) {
  const Street street(12);
  const SourceChoice choice = Select(street, {.max_seeds = 100})[6];
  const Rigid3 world_from_cam = street.images.at(ImageId(6)).cam_from_world.Inverse();
  ASSERT_EQ(choice.seeds.size(), 100U);
  for (const DepthSeed& seed : choice.seeds) {
    const Vector3d point = world_from_cam * (seed.range_m * seed.bearing);
    const auto nearest = std::ranges::min(street.tracks, {}, [&point](const Track& track) {
      return (track.point_in_world - point).norm();
    });
    EXPECT_LT((nearest.point_in_world - point).norm(), 1e-4);
    EXPECT_GT(seed.sigma_m, 0.0);
    EXPECT_GT(seed.range_m, choice.min_range_m);
    EXPECT_LT(seed.range_m, choice.max_range_m);
  }
}

TEST(SelectSources, JudgesByDistanceWhereThereAreNoPoints) {
  Street street(12);
  street.tracks.clear();
  const SourceChoice choice = Select(street, {.near_m = 2.0, .far_m = 30.0})[6];
  EXPECT_TRUE(choice.problem.empty());
  EXPECT_GE(choice.sources.size(), 4U);
  EXPECT_TRUE(choice.seeds.empty());
  EXPECT_EQ(choice.min_range_m, 2.0);
  EXPECT_EQ(choice.max_range_m, 30.0);
}

TEST(SelectSources, SaysWhyThereAreNone) {
  EXPECT_NE(Select(Street(1))[0].problem, "");
  Street standing(3, 0.0);
  for (const SourceChoice& choice : Select(standing)) EXPECT_NE(choice.problem, "");
  Street street(4);
  street.images[ImageId(2)].loose = true;
  const auto choices = Select(street);
  EXPECT_NE(choices[2].problem, "");
  for (const SourceChoice& choice : choices) {
    EXPECT_FALSE(std::ranges::count(choice.sources, ImageId(2))) << choice.image.value;
  }
}

}  // namespace
}  // namespace orbweave
