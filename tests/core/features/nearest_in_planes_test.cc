// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/nearest_in_planes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/random.h"
#include "core/features/axial_features.h"
#include "core/features/match_descriptors.h"
#include "core/features/match_options.h"
#include "core/geometry/rigid3.h"
#include "core/geometry/rotation.h"
#include "tests/core/features/squared_distance.h"
#include "tests/support/random_features.h"

namespace orbweave {
namespace {

using std::numbers::pi;

constexpr EquirectangularCamera kCamera{.width_px = 4000, .height_px = 2000};
const double kMaxErrorRad = kCamera.AngleFromPixels(4.0);

struct Scene {
  Features a{.camera = kCamera};
  Features b{.camera = kCamera};
  Rigid3 b_from_a{};
};

std::vector<FeatureMatch> MatchGuided(const Features& a,
                                      const Features& b,
                                      const Rigid3& b_from_a,
                                      double max_error_rad,
                                      const MatchOptions& options) {
  const PairSide side_a(a);
  const PairSide side_b(b);
  const NearestInPlanes planes(side_a, side_b, b_from_a.translation, max_error_rad);
  return AcceptGuided(planes.Find(b_from_a.rotation), options);
}

/// Points all round two cameras; feature i of both is the same point.
Scene MakeScene(uint64_t seed, int count) {
  Random random(seed);
  Scene scene;
  scene.b_from_a.rotation =
      Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal())
          .normalized();
  scene.b_from_a.translation =
      Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d direction =
        Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
    const Eigen::Vector3d point = random.Uniform(1.0, 20.0) * direction;
    const std::vector<uint8_t> descriptor = testing::RandomDescriptor(random);
    testing::AppendFeature(scene.a, point, descriptor);
    testing::AppendFeature(scene.b, scene.b_from_a * point, descriptor);
  }
  return scene;
}

TEST(NearestInPlanes, FindsPlantedMatchesAllRoundTheSphere) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const Scene scene = MakeScene(seed, 400);
    const auto matches = MatchGuided(scene.a, scene.b, scene.b_from_a, kMaxErrorRad, {});
    EXPECT_EQ(matches.size(), 400U) << seed;
    for (const FeatureMatch& match : matches) EXPECT_EQ(match.a, match.b);
  }
}

TEST(NearestInPlanes, FindsPointsOnTheBaselineItself) {
  Scene scene = MakeScene(6, 0);
  scene.b_from_a.rotation = Eigen::Quaterniond::Identity();
  scene.b_from_a.translation = {0.0, 0.0, -1.0};  // b one step ahead of a
  Random random(7);
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(0, 0, 5), Eigen::Vector3d(0, 0, -5)}) {
    const std::vector<uint8_t> descriptor = testing::RandomDescriptor(random);
    testing::AppendFeature(scene.a, point, descriptor);
    testing::AppendFeature(scene.b, scene.b_from_a * point, descriptor);
  }
  EXPECT_EQ(MatchGuided(scene.a, scene.b, scene.b_from_a, kMaxErrorRad, {}),
            (std::vector<FeatureMatch>{{0, 0}, {1, 1}}));
}

TEST(NearestInPlanes, TellsEqualDescriptorsApartByGeometry) {
  Scene scene = MakeScene(8, 40);
  for (Features* features : {&scene.a, &scene.b}) {  // repeated windows: five kinds of descriptor
    for (size_t i = 5; i < 40; ++i) {
      std::copy_n(features->descriptors.begin() + static_cast<ptrdiff_t>(i % 5) * kDescriptorSize,
                  kDescriptorSize,
                  features->descriptors.begin() + static_cast<ptrdiff_t>(i) * kDescriptorSize);
    }
  }
  EXPECT_LT(MatchDescriptors(scene.a, scene.b, {}).size(), 5U);
  const auto matches = MatchGuided(scene.a, scene.b, scene.b_from_a, kMaxErrorRad, {});
  EXPECT_GT(matches.size(), 30U);
  for (const FeatureMatch& match : matches) EXPECT_EQ(match.a, match.b);
}

TEST(NearestInPlanes, RejectsPointsOffTheEpipolarPlane) {
  const Scene scene = MakeScene(9, 300);
  const Eigen::Vector3d axis = scene.b_from_a.translation;
  for (const double error_px : {3.0, 6.0}) {
    Scene moved = scene;
    for (FeatureIndex i = 0; i < moved.b.size(); ++i) {
      const Eigen::Vector3d bearing = moved.b.Bearing(i);
      const Eigen::Vector3d normal = axis.cross(bearing).normalized();
      const Eigen::Vector3d off = bearing + std::tan(kCamera.AngleFromPixels(error_px)) * normal;
      const Eigen::Vector2d pixel = kCamera.PixelFromBearing(off);
      moved.b.keypoints[i].x_px = static_cast<float>(pixel.x());
      moved.b.keypoints[i].y_px = static_cast<float>(pixel.y());
    }
    const size_t found = MatchGuided(moved.a, moved.b, moved.b_from_a, kMaxErrorRad, {}).size();
    if (error_px < 4.0) {
      EXPECT_GT(found, 290U);
    } else {
      EXPECT_LT(found, 10U);
    }
  }
}

TEST(NearestInPlanes, RejectsPointsBehindASphere) {
  Scene scene = MakeScene(10, 200);
  for (FeatureIndex i = 0; i < scene.b.size(); ++i) {  // the antipode lies on the same great circle
    const Eigen::Vector2d pixel = kCamera.PixelFromBearing(-scene.b.Bearing(i));
    scene.b.keypoints[i].x_px = static_cast<float>(pixel.x());
    scene.b.keypoints[i].y_px = static_cast<float>(pixel.y());
  }
  EXPECT_LT(MatchGuided(scene.a, scene.b, scene.b_from_a, kMaxErrorRad, {}).size(), 4U);
}

TEST(NearestInPlanes, RejectsBearingsThatMeetBehindTheCameras) {
  // In b the point must appear further from the direction of motion than in a; exchanged, the
  // rays part and meet behind.
  Scene scene = MakeScene(11, 200);
  const Rigid3 backwards{scene.b_from_a.rotation, -scene.b_from_a.translation};
  EXPECT_LT(MatchGuided(scene.a, scene.b, backwards, kMaxErrorRad, {}).size(), 20U);
}

TEST(NearestInPlanes, IsSymmetric) {
  Scene scene = MakeScene(12, 300);
  const Scene noise = MakeScene(13, 300);
  scene.b.keypoints.insert(
      scene.b.keypoints.end(), noise.b.keypoints.begin(), noise.b.keypoints.end());
  scene.b.descriptors.insert(
      scene.b.descriptors.end(), noise.a.descriptors.begin(), noise.a.descriptors.end());
  MatchOptions loose;
  loose.max_distance = 2.0;
  loose.guided_max_ratio = 1.0;
  const auto ab = MatchGuided(scene.a, scene.b, scene.b_from_a, kMaxErrorRad, loose);
  std::vector<FeatureMatch> ba;
  for (const FeatureMatch& match :
       MatchGuided(scene.b, scene.a, scene.b_from_a.Inverse(), kMaxErrorRad, loose)) {
    ba.push_back({match.b, match.a});
  }
  std::sort(ba.begin(), ba.end());
  EXPECT_EQ(ab, ba);
}

TEST(NearestInPlanes, IsOneToOne) {
  const Scene scene = MakeScene(14, 50);
  Features twice = scene.b;
  twice.keypoints.insert(twice.keypoints.end(), scene.b.keypoints.begin(), scene.b.keypoints.end());
  twice.descriptors.insert(
      twice.descriptors.end(), scene.b.descriptors.begin(), scene.b.descriptors.end());
  MatchOptions options;
  options.guided_max_ratio = 1.0;
  std::set<FeatureIndex> used;
  for (const FeatureMatch& match :
       MatchGuided(twice, scene.b, scene.b_from_a, kMaxErrorRad, options)) {
    EXPECT_TRUE(used.insert(match.b).second);
  }
}

/// By the angles themselves.
bool IsWithin(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double max_error_rad) {
  const double polar_a = std::atan2(std::hypot(a.x(), a.y()), a.z());
  const double polar_b = std::atan2(std::hypot(b.x(), b.y()), b.z());
  if (polar_b > polar_a + max_error_rad) return false;
  const double sine = std::sin(max_error_rad);
  const double largest = std::max(std::sin(polar_a), std::sin(polar_b));
  if (largest <= sine) return std::abs(polar_a - polar_b) < 0.5 * pi;
  const double angle = std::atan2(a.y(), a.x()) - std::atan2(b.y(), b.x());
  return std::cos(angle) > 0.0 && largest * std::abs(std::sin(angle)) <= sine;
}

/// Features within the wedge of `a`; none may be named twice.
std::set<FeatureIndex> Within(const AxialFeatures& axial,
                              const AxialBearing& a,
                              double max_error_rad) {
  const EpipolarWedge wedge(a, AngularError(max_error_rad));
  std::set<FeatureIndex> found;
  for (const AxialFeatures::Blocks& blocks : axial.BlocksNear(wedge)) {
    const size_t first = blocks.begin * AxialFeatures::kRowsPerBlock;
    std::vector<int32_t> held((blocks.end - blocks.begin) * AxialFeatures::kRowsPerBlock);
    axial.Test(wedge, blocks, held.data());
    for (size_t i = 0; i < held.size(); ++i) {
      if (held[i] == 0) continue;
      EXPECT_LT(first + i, axial.size());
      EXPECT_TRUE(found.insert(axial.Indices()[first + i]).second);
    }
  }
  return found;
}

TEST(AxialFeatures, FindsAllAndOnlyWhatIsWithinAWedge) {
  Random random(16);
  const auto direction = [&] {
    return Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
  };
  std::vector<Eigen::Vector3d> bearings = {
      {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (int i = 0; i < 3000; ++i) bearings.push_back(direction());
  for (int i = 0; i < 200; ++i)  // near both ends of the axis, and where the turn begins and ends
    bearings.push_back((Eigen::Vector3d(i % 3 - 1, 0, 0) + 0.02 * direction()).normalized());
  for (int i = 0; i < 200; ++i)
    bearings.push_back(
        (Eigen::Vector3d(0, 0, i % 2 == 0 ? 1 : -1) + 0.02 * direction()).normalized());
  const AxialFeatures axial(bearings, Eigen::Quaterniond::Identity());
  constexpr double kRoundingRad = 2e-6;
  for (const double max_error_rad : {0.001, 0.02, 0.3, 0.5}) {
    for (size_t row = 0; row < axial.size(); row += 41) {
      const std::set<FeatureIndex> found = Within(axial, axial.At(row), max_error_rad);
      const Eigen::Vector3d& a = bearings[axial.Indices()[row]];
      for (FeatureIndex i = 0; i < bearings.size(); ++i) {
        const bool is_inside = IsWithin(a, bearings[i], max_error_rad - kRoundingRad);
        const bool is_outside = !IsWithin(a, bearings[i], max_error_rad + kRoundingRad);
        if (is_inside || is_outside) {
          ASSERT_EQ(found.contains(i), is_inside) << row << " " << i << " " << max_error_rad;
        }
      }
    }
  }
}

TEST(AxialFeatures, NamesNoFeatureTwiceWhereThereAreFew) {
  Random random(17);
  for (const size_t count : {1, 2, 15, 16, 17, 40, 100}) {
    std::vector<Eigen::Vector3d> bearings;
    for (size_t i = 0; i < count; ++i) {
      bearings.push_back(
          Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized());
    }
    const AxialFeatures axial(bearings, Eigen::Quaterniond::Identity());
    for (const double max_error_rad : {0.01, 0.2, 0.6}) {
      for (size_t row = 0; row < count; ++row)
        EXPECT_TRUE(Within(axial, axial.At(row), max_error_rad).contains(axial.Indices()[row]));
    }
  }
}

/// What NearestInPlanes says, one pair after the other.
NearestTwoBothWays ByLooking(const PairSide& a,
                             const PairSide& b,
                             const Rigid3& b_from_a,
                             double max_error_rad) {
  const Eigen::Quaterniond axial_from_b =
      RotationBetween(b_from_a.translation, Eigen::Vector3d::UnitZ());
  const AxialFeatures axial_a(a.bearings, axial_from_b * b_from_a.rotation);
  const AxialFeatures axial_b(b.bearings, axial_from_b);
  NearestTwoBothWays nearest{.of_a = std::vector<NearestTwo>(a.features.size()),
                             .of_b = std::vector<NearestTwo>(b.features.size())};
  const auto see = [](NearestTwo& of, int32_t distance, FeatureIndex index) {
    of = MergeNearest(of, {distance, kNoDistance, index});
  };
  for (size_t row = 0; row < axial_a.size(); ++row) {
    const FeatureIndex i = axial_a.Indices()[row];
    for (const FeatureIndex j : Within(axial_b, axial_a.At(row), max_error_rad)) {
      const int32_t distance =
          testing::SquaredDistance(a.features.Descriptor(i), b.features.Descriptor(j));
      see(nearest.of_a[i], distance, j);
      see(nearest.of_b[j], distance, i);
    }
  }
  return nearest;
}

class EveryKernelInPlanes : public ::testing::TestWithParam<DistanceKernel> {};
INSTANTIATE_TEST_SUITE_P(Kernels,
                         EveryKernelInPlanes,
                         ::testing::ValuesIn(AvailableDistanceKernels()));

TEST_P(EveryKernelInPlanes, FindsWhatLookingAtEachPairFinds) {
  for (const int count : {1, 15, 33, 500}) {
    const Scene scene = MakeScene(18, count);
    const PairSide a(scene.a);
    const PairSide b(scene.b);
    const NearestInPlanes planes(a, b, scene.b_from_a.translation, kMaxErrorRad, GetParam());
    const NearestTwoBothWays found = planes.Find(scene.b_from_a.rotation);
    const NearestTwoBothWays expected = ByLooking(a, b, scene.b_from_a, kMaxErrorRad);
    EXPECT_EQ(found.of_a, expected.of_a) << count;
    EXPECT_EQ(found.of_b, expected.of_b) << count;
  }
}

TEST(PseudoAngle, GrowsWithTheAngle) {
  float last = -1.0F;
  for (int i = 0; i < 3600; ++i) {
    const double angle = i * pi / 1800.0;
    const float pseudo =
        PseudoAngle(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
    EXPECT_GE(pseudo, last);
    EXPECT_LE(pseudo - std::max(last, 0.0F), 1.0001 * pi / 1800.0);
    last = pseudo;
  }
  EXPECT_NEAR(last, 4.0F, 0.01F);
}

}  // namespace
}  // namespace orbweave
