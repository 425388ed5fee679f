// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/seen_between.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// Panoramas 8 m apart along a street, each turned as it likes, and points on both of its sides.
class Street {
 public:
  explicit Street(const std::vector<Vector3d>& centres) {
    Random random(1);
    for (uint32_t i = 0; i < centres.size(); ++i) {
      subproblem_.scene.images[ImageId(i)].cam_from_world =
          Rigid3::FromCentre(testing::RandomRotation(random), centres[i]);
    }
  }

  void AddPoint(const Vector3d& at, const std::vector<uint32_t>& observers) {
    Track& track = subproblem_.scene.tracks.emplace_back();
    track.point_in_world = at;
    for (const uint32_t observer : observers)
      track.observations.push_back({.ref = {ImageId(observer), 0}});
  }
  [[nodiscard]] SeenBetween Of(uint32_t image) const {
    for (const SeenBetween& count : CountSeenBetween(subproblem_)) {
      if (count.image == ImageId(image)) return count;
    }
    return {.image = ImageId(image)};
  }
  [[nodiscard]] Subproblem& subproblem() { return subproblem_; }

 private:
  Subproblem subproblem_{};
};

const std::vector<Vector3d> kAlong = {
    {0.0, 0.0, 2.5}, {8.0, 0.3, 2.5}, {16.0, 0.0, 2.5}, {24.0, -0.2, 2.5}};

TEST(CountSeenBetween, AsksWhoStandsBetweenTwoThatSeeAPoint) {
  Street street(kAlong);
  street.AddPoint({9.0, 7.0, 4.0}, {0, 2});
  street.AddPoint({9.0, -7.0, 4.0}, {0, 1, 2});
  EXPECT_EQ(street.Of(1).asked, 2U);
  EXPECT_EQ(street.Of(1).seen, 1U);
  for (const uint32_t outside : {0U, 2U, 3U}) EXPECT_EQ(street.Of(outside).asked, 0U) << outside;
}

TEST(CountSeenBetween, AsksNobodyForWhatOneSideAloneSees) {
  Street street(kAlong);
  street.AddPoint({9.0, 7.0, 4.0}, {0, 1});
  street.AddPoint({9.0, 7.0, 4.0}, {2, 3});
  for (uint32_t i = 0; i < 4; ++i) EXPECT_EQ(street.Of(i).asked, 0U) << i;
}

/// On the line between two who see a point far ahead, under nearly the same angle.
TEST(CountSeenBetween, DoesNotAskForWhatIsSeenUnderOneAngle) {
  Street street(kAlong);
  street.AddPoint({900.0, 1.0, 4.0}, {0, 2});
  EXPECT_EQ(street.Of(1).asked, 0U);
}

/// Beyond the point, or beside the way of both.
TEST(CountSeenBetween, DoesNotAskWhoStandsElsewhere) {
  std::vector<Vector3d> centres = kAlong;
  centres.push_back({9.0, 14.0, 2.5});
  centres.push_back({9.0, -30.0, 2.5});
  centres.push_back({9.0, 0.0, 12.0});
  Street street(centres);
  street.AddPoint({9.0, 7.0, 4.0}, {0, 2});
  for (const uint32_t elsewhere : {4U, 5U, 6U}) EXPECT_EQ(street.Of(elsewhere).asked, 0U);
}

TEST(CountSeenBetween, TakesNoPartOfLooseImages) {
  Street street(kAlong);
  street.AddPoint({9.0, 7.0, 4.0}, {0, 1, 2});
  street.subproblem().scene.images.at(ImageId(1)).loose = true;
  EXPECT_EQ(street.Of(1).asked, 0U);
  street.subproblem().scene.images.at(ImageId(1)).loose = false;
  street.subproblem().scene.images.at(ImageId(0)).loose = true;
  EXPECT_EQ(street.Of(1).asked, 0U);
}

/// Where a panorama is put a house too far along, what others see from either side is not what its
/// own points are of.
TEST(CountSeenBetween, TellsAPanoramaThatStandsElsewhere) {
  Street street(kAlong);
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Vector3d at(random.Uniform(2.0, 22.0), random.Uniform() < 0.5 ? 7.0 : -7.0, 4.0);
    std::vector<uint32_t> observers;
    for (uint32_t k = 0; k < 4; ++k) {
      if (k != 1 && random.Uniform() < 0.6) observers.push_back(k);
    }
    street.AddPoint(at, observers);
  }
  EXPECT_GT(street.Of(1).asked, 50U);
  EXPECT_EQ(street.Of(1).seen, 0U);
  EXPECT_GT(street.Of(2).asked, 30U);
  EXPECT_GT(3 * street.Of(2).seen, street.Of(2).asked);
}

TEST(CountSeenBetween, LooksAtNoMoreTracksThanItWould) {
  Street street(kAlong);
  for (int i = 0; i < 250000; ++i) street.AddPoint({9.0, 7.0, 4.0}, {0, 1, 2});
  EXPECT_GT(street.Of(1).asked, 50000U);
  EXPECT_LE(street.Of(1).asked, 100000U);
  EXPECT_EQ(street.Of(1).asked, street.Of(1).seen);
}

}  // namespace
}  // namespace orbweave
