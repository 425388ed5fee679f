// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/estimate_two_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <utility>
#include <vector>

#include "core/estimators/two_view_options.h"
#include "core/geometry/rotation.h"
#include "core/synthetic/make_street.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::BearingOf;
using testing::MakeTwoViewWorld;
using testing::RandomDirection;
using testing::RandomPoint;
using testing::RandomRotation;
using testing::RotationError;
using testing::TwoViewWorld;
using testing::WithNoise;

constexpr double kSigmaRad = 1e-3;
constexpr double kMaxErrorRad = 4.7e-3;  // 4 px of a panorama 5376 px wide
const ImagePair kPair = {ImageId(3), ImageId(7)};

std::vector<FeatureMatch> MatchesInOrder(size_t count) {
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < count; ++i) matches.push_back({i, i});
  return matches;
}

TwoViewGeometry Estimate(const TwoViewWorld& world, const TwoViewOptions& options = {}) {
  const auto matches = MatchesInOrder(world.bearings_a.size());
  const auto geometry = EstimateTwoView(
      kPair, world.bearings_a, world.bearings_b, matches, kMaxErrorRad, options, {.seed = 1});
  EXPECT_TRUE(geometry.ok()) << geometry.status();
  return *geometry;
}

double DirectionError(const TwoViewGeometry& geometry, const TwoViewWorld& world) {
  return AngleBetween(geometry.b_from_a.translation, world.b_from_a.translation);
}

/// Image b sees the points from the same centre, turned.
TwoViewWorld MakePureRotationWorld(uint64_t seed,
                                   size_t count,
                                   double outlier_share,
                                   double sigma_rad) {
  TwoViewWorld world = MakeTwoViewWorld(seed, count, outlier_share, sigma_rad);
  Random random(seed + 1000);
  world.b_from_a.translation.setZero();
  for (size_t i = world.num_outliers; i < count; ++i) {
    world.bearings_b[i] =
        WithNoise(random, BearingOf(world.b_from_a, world.points_in_a[i]), sigma_rad);
  }
  return world;
}

/// Points on a facade 3 baselines away, the first `num_off_plane` before and behind it. From a
/// plane alone two poses fit equally well; the few others decide.
TwoViewWorld MakePlanarWorld(uint64_t seed, size_t count, size_t num_off_plane, double sigma_rad) {
  Random random(seed);
  TwoViewWorld world;
  world.b_from_a = {RandomRotation(random), RandomDirection(random)};
  const Eigen::Quaterniond facing = RandomRotation(random);
  for (size_t i = 0; i < count; ++i) {
    const double x = random.Uniform(-6.0, 6.0);
    const double y = random.Uniform(-6.0, 6.0);
    const double z = i < num_off_plane ? random.Uniform(-6.0, 6.0) : 3.0;
    const Vector3d X = facing * Vector3d(x, y, z);
    world.points_in_a.push_back(X);
    world.bearings_a.push_back(WithNoise(random, X.normalized(), sigma_rad));
    world.bearings_b.push_back(WithNoise(random, BearingOf(world.b_from_a, X), sigma_rad));
  }
  return world;
}

TEST(EstimateTwoView, IsExactOnCleanData) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 60);
    const TwoViewGeometry geometry = Estimate(world);
    EXPECT_EQ(geometry.kind, TwoViewKind::kGeneral) << seed;
    EXPECT_EQ(geometry.inliers.size(), 60U) << seed;
    EXPECT_LT(RotationError(geometry.b_from_a.rotation, world.b_from_a.rotation), 1e-6) << seed;
    EXPECT_LT(DirectionError(geometry, world), 1e-6) << seed;
    EXPECT_NEAR(geometry.b_from_a.translation.norm(), 1.0, 1e-12);
  }
}

/// Matches of a world in the order of a rating that right ones have smaller on average.
std::vector<FeatureMatch> RatedMatches(const TwoViewWorld& world, double largest_of_right) {
  Random random(5);
  std::vector<std::pair<double, FeatureMatch>> rated;
  for (uint32_t i = 0; i < world.bearings_a.size(); ++i) {
    const double largest = i < world.num_outliers ? 1.0 : largest_of_right;
    rated.push_back({random.Uniform(0.0, largest), {i, i}});
  }
  std::ranges::sort(rated);
  std::vector<FeatureMatch> matches;
  for (const auto& [rating, match] : rated) matches.push_back(match);
  return matches;
}

/// In how many of eight worlds with so many wrong matches the pose is found.
int CountFound(double outlier_share, double largest_of_right, MatchOrder order) {
  int found = 0;
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 400, outlier_share, kSigmaRad);
    const auto geometry = EstimateTwoView(kPair,
                                          world.bearings_a,
                                          world.bearings_b,
                                          RatedMatches(world, largest_of_right),
                                          kMaxErrorRad,
                                          {},
                                          {.seed = seed},
                                          {.order = order});
    EXPECT_TRUE(geometry.ok()) << geometry.status();
    if (geometry->kind != TwoViewKind::kGeneral) continue;
    EXPECT_LT(RotationError(geometry->b_from_a.rotation, world.b_from_a.rotation), 1e-2) << seed;
    ++found;
  }
  return found;
}

TEST(EstimateTwoView, FindsFewRightMatchesAmongTheBest) {
  EXPECT_LE(CountFound(0.9, 0.15, MatchOrder::kUnknown), 4);
  EXPECT_EQ(CountFound(0.9, 0.15, MatchOrder::kBestFirst), 8);
}

TEST(EstimateTwoView, IsNotMisledByAnOrderThatIsWrong) {
  EXPECT_EQ(CountFound(0.7, 3.0, MatchOrder::kBestFirst), 8);
}

/// A chain over a panorama somewhere between the two of a world, and as far again aside.
PredictedPose PredictedOf(const TwoViewWorld& world, double off_rad) {
  Random random(9);
  const Vector3d to_b = world.b_from_a.Centre();
  const Vector3d m = 0.4 * to_b + 0.2 * to_b.cross(RandomDirection(random)).normalized();
  const Rigid3 m_from_a = Rigid3::FromCentre(RandomRotation(random), m);
  PredictedPose predicted = PredictPose(m_from_a, world.b_from_a * m_from_a.Inverse());
  predicted.rotation = predicted.rotation * RotationFromVector(off_rad * RandomDirection(random));
  return predicted;
}

TwoViewGeometry EstimateAsPredicted(const TwoViewWorld& world, const PredictedPose& predicted) {
  const auto geometry = EstimateTwoView(kPair,
                                        world.bearings_a,
                                        world.bearings_b,
                                        MatchesInOrder(world.bearings_a.size()),
                                        kMaxErrorRad,
                                        {},
                                        {.seed = 1},
                                        {.predicted = predicted});
  EXPECT_TRUE(geometry.ok()) << geometry.status();
  return *geometry;
}

TEST(EstimateTwoView, FindsFewRightMatchesWhereTheTurnIsPredicted) {
  int without = 0;
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 800, 0.94, kSigmaRad);
    without += Estimate(world).kind == TwoViewKind::kNone ? 0 : 1;
    const TwoViewGeometry geometry =
        EstimateAsPredicted(world, PredictedOf(world, 0.3 * kMaxErrorRad));
    EXPECT_EQ(geometry.kind, TwoViewKind::kGeneral) << seed;
    EXPECT_LT(RotationError(geometry.b_from_a.rotation, world.b_from_a.rotation), 1e-2) << seed;
    EXPECT_LT(DirectionError(geometry, world), 2e-2) << seed;
  }
  EXPECT_LE(without, 2);
}

TEST(EstimateTwoView, FindsNothingWhereWhatIsPredictedIsWrong) {
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 400, 0.5, kSigmaRad);
    EXPECT_EQ(EstimateAsPredicted(world, PredictedOf(world, 1.0)).kind, TwoViewKind::kNone) << seed;
    PredictedPose elsewhere = PredictedOf(world, 0.0);
    elsewhere.first = -elsewhere.first;
    elsewhere.last = elsewhere.first;
    EXPECT_EQ(EstimateAsPredicted(world, elsewhere).kind, TwoViewKind::kNone) << seed;
  }
}

struct Case {
  TwoViewSolver solver;
  double outlier_share;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << internal::ValueToText(c.solver) << " with " << 100.0 * c.outlier_share << " % outliers";
}

class EstimateTwoViewWithOutliers : public ::testing::TestWithParam<Case> {};

TEST_P(EstimateTwoViewWithOutliers, IsRightForEverySeed) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 400, GetParam().outlier_share, kSigmaRad);
    const TwoViewGeometry geometry = Estimate(world, {.solver = GetParam().solver});
    EXPECT_EQ(geometry.kind, TwoViewKind::kGeneral) << seed;
    EXPECT_LT(RotationError(geometry.b_from_a.rotation, world.b_from_a.rotation), 2e-3) << seed;
    EXPECT_LT(DirectionError(geometry, world), 6e-3) << seed;
    const auto num_right = static_cast<double>(400 - world.num_outliers);
    EXPECT_GT(static_cast<double>(geometry.inliers.size()), 0.97 * num_right) << seed;
    EXPECT_LT(static_cast<double>(geometry.inliers.size()), num_right + 10) << seed;
    EXPECT_EQ(geometry.num_putative, 400U);
  }
}

INSTANTIATE_TEST_SUITE_P(Shares,
                         EstimateTwoViewWithOutliers,
                         ::testing::Values(Case{TwoViewSolver::kFivePoint, 0.3},
                                           Case{TwoViewSolver::kFivePoint, 0.5},
                                           Case{TwoViewSolver::kFivePoint, 0.7},
                                           Case{TwoViewSolver::kEightPoint, 0.3}));

TEST(EstimateTwoView, UprightSolverNeedsFewTrialsAndBearsATilt) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    TwoViewWorld world = MakeTwoViewWorld(seed, 300, 0.7, kSigmaRad);
    const Eigen::Quaterniond tilt = RotationFromVector(0.003 * RandomDirection(random));
    const double heading_rad = random.Uniform(-3.2, 3.2);
    world.b_from_a.rotation =
        tilt * Eigen::Quaterniond(Eigen::AngleAxisd(heading_rad, Vector3d::UnitY()));
    for (size_t i = world.num_outliers; i < 300; ++i) {
      world.bearings_b[i] =
          WithNoise(random, BearingOf(world.b_from_a, world.points_in_a[i]), kSigmaRad);
    }
    const TwoViewGeometry geometry =
        Estimate(world, {.solver = TwoViewSolver::kUprightThreePoint, .max_trials = 400});
    EXPECT_LT(RotationError(geometry.b_from_a.rotation, world.b_from_a.rotation), 2e-3) << seed;
    EXPECT_LT(DirectionError(geometry, world), 1e-2) << seed;
  }
}

TEST(EstimateTwoView, CommutesWithRotationsOfEitherCamera) {
  const TwoViewWorld world = MakeTwoViewWorld(5, 200, 0.4, kSigmaRad);
  const TwoViewGeometry before = Estimate(world);
  Random random(9);
  const Eigen::Quaterniond turn_a = RandomRotation(random);
  const Eigen::Quaterniond turn_b = RandomRotation(random);
  TwoViewWorld turned = world;
  for (Vector3d& bearing : turned.bearings_a) bearing = turn_a * bearing;
  for (Vector3d& bearing : turned.bearings_b) bearing = turn_b * bearing;
  const TwoViewGeometry after = Estimate(turned);
  EXPECT_EQ(after.inliers, before.inliers);
  EXPECT_LT(RotationError(after.b_from_a.rotation,
                          turn_b * before.b_from_a.rotation * turn_a.conjugate()),
            1e-4);
  EXPECT_LT(AngleBetween(after.b_from_a.translation, turn_b * before.b_from_a.translation), 1e-4);
  EXPECT_NEAR(after.median_angle_rad, before.median_angle_rad, 1e-4);
}

TEST(EstimateTwoView, FlagsPureRotation) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const TwoViewWorld world = MakePureRotationWorld(seed, 200, 0.3, kSigmaRad);
    const TwoViewGeometry geometry = Estimate(world);
    EXPECT_EQ(geometry.kind, TwoViewKind::kPureRotation) << seed;
    EXPECT_EQ(geometry.b_from_a.translation, Vector3d::Zero());
    EXPECT_LT(RotationError(geometry.b_from_a.rotation, world.b_from_a.rotation), 1e-3) << seed;
    EXPECT_GT(geometry.inliers.size(), 135U) << seed;
    EXPECT_LT(geometry.inliers.size(), 143U) << seed;
    EXPECT_LT(geometry.median_angle_rad, 3e-3);
  }
}

TEST(EstimateTwoView, FlagsPlanesAndStillFindsThePose) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const TwoViewWorld world = MakePlanarWorld(seed, 300, 24, 0.3 * kSigmaRad);
    const TwoViewGeometry geometry = Estimate(world);
    EXPECT_EQ(geometry.kind, TwoViewKind::kPlanar) << seed;
    EXPECT_LT(RotationError(geometry.b_from_a.rotation, world.b_from_a.rotation), 1e-2) << seed;
    EXPECT_LT(DirectionError(geometry, world), 3e-2) << seed;
  }
}

TEST(EstimateTwoView, FlagsScenesThatAreNothingButAPlane) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const TwoViewGeometry geometry = Estimate(MakePlanarWorld(seed, 200, 0, 0.3 * kSigmaRad));
    EXPECT_EQ(geometry.kind, TwoViewKind::kPlanar) << seed;
    EXPECT_GT(geometry.inliers.size(), 195U) << seed;
  }
}

TEST(EstimateTwoView, KeepsFarPointsWithoutParallaxThatAreNoSky) {
  TwoViewWorld world = MakeTwoViewWorld(8, 200, 0.0, kSigmaRad);
  Random random(4);
  for (size_t i = 0; i < 60; ++i) {
    Vector3d X = 1e4 * RandomDirection(random);
    while (X.y() < 0.0 || (world.b_from_a.rotation * X).y() < 0.0)
      X = 1e4 * RandomDirection(random);
    world.bearings_a[i] = WithNoise(random, X.normalized(), kSigmaRad);
    world.bearings_b[i] = WithNoise(random, BearingOf(world.b_from_a, X), kSigmaRad);
  }
  EXPECT_GT(Estimate(world).inliers.size(), 190U);
}

TEST(EstimateTwoView, ReportsParallaxSpreadAndSortedInliers) {
  const TwoViewWorld world = MakeTwoViewWorld(2, 500, 0.2, kSigmaRad);
  auto matches = MatchesInOrder(500);
  std::reverse(matches.begin(), matches.end());
  const auto geometry = EstimateTwoView(
      kPair, world.bearings_a, world.bearings_b, matches, kMaxErrorRad, {}, {.seed = 1});
  ASSERT_TRUE(geometry.ok());
  EXPECT_EQ(geometry->pair, kPair);
  EXPECT_TRUE(std::is_sorted(geometry->inliers.begin(), geometry->inliers.end()));
  EXPECT_GT(geometry->spread, 0.95);
  EXPECT_NEAR(geometry->median_angle_rad, 0.13, 0.05);  // unit baseline, points at 2 ... 10
}

TEST(EstimateTwoView, IsDeterministic) {
  const TwoViewWorld world = MakeTwoViewWorld(6, 300, 0.5, kSigmaRad);
  const TwoViewGeometry once = Estimate(world);
  const TwoViewGeometry again = Estimate(world);
  EXPECT_EQ(once.inliers, again.inliers);
  EXPECT_EQ(once.b_from_a.translation, again.b_from_a.translation);
}

TEST(EstimateTwoView, HasNoAnswerWithoutSupport) {
  EXPECT_EQ(Estimate(MakeTwoViewWorld(1, 100, 1.0)).kind, TwoViewKind::kNone);
  EXPECT_EQ(Estimate(MakeTwoViewWorld(1, 9)).kind, TwoViewKind::kNone);
  EXPECT_EQ(Estimate({}).kind, TwoViewKind::kNone);
  EXPECT_EQ(Estimate(MakeTwoViewWorld(1, 100, 0.6), {.min_inlier_share = 0.5}).kind,
            TwoViewKind::kNone);
  EXPECT_EQ(Estimate(MakeTwoViewWorld(1, 100, 1.0)).num_putative, 100U);
}

TEST(EstimateTwoView, SurvivesIdenticalBearings) {
  for (const TwoViewSolver solver :
       {TwoViewSolver::kFivePoint, TwoViewSolver::kEightPoint, TwoViewSolver::kUprightThreePoint}) {
    TwoViewWorld world;
    world.bearings_a.assign(30, Vector3d::UnitZ());
    world.bearings_b.assign(30, Vector3d::UnitX());
    const TwoViewGeometry geometry = Estimate(world, {.solver = solver, .max_trials = 200});
    EXPECT_TRUE(geometry.b_from_a.translation.allFinite());
    EXPECT_TRUE(geometry.b_from_a.rotation.coeffs().allFinite());
    EXPECT_NE(geometry.kind, TwoViewKind::kGeneral);
  }
}

TEST(EstimateTwoView, StopsOnRequest) {
  std::stop_source source;
  source.request_stop();
  const TwoViewWorld world = MakeTwoViewWorld(1, 100);
  const auto geometry = EstimateTwoView(kPair,
                                        world.bearings_a,
                                        world.bearings_b,
                                        MatchesInOrder(100),
                                        kMaxErrorRad,
                                        {},
                                        {.stop = source.get_token(), .seed = 1});
  EXPECT_EQ(geometry.status().code(), absl::StatusCode::kCancelled);
}

constexpr double kFortyDegreesOfNadir = 0.77;
/// What a car's roof hides, too: it covers more of the sphere than a street does.
constexpr double kBelow25Degrees = 0.42;

/// Adds matches at the same place of both panoramas whose bearings have that y or more.
void AddRoof(size_t count, TwoViewWorld& world, double least_y = kFortyDegreesOfNadir) {
  Random random(77);
  for (size_t i = 0; i < count; ++i) {
    Vector3d spot = RandomDirection(random);
    while (spot.y() < least_y) spot = RandomDirection(random);
    world.bearings_a.push_back(WithNoise(random, spot, kSigmaRad));
    world.bearings_b.push_back(WithNoise(random, spot, kSigmaRad));
  }
}

TEST(EstimateTwoView, IsNotMisledByACarrierThatMatchesMoreThanTheScene) {
  TwoViewWorld world = MakeTwoViewWorld(5, 100, 0.1, kSigmaRad);
  world.b_from_a.rotation = RotationFromVector({0.01, 0.005, -0.01});  // drives straight on
  Random random(6);
  for (size_t i = world.num_outliers; i < 100; ++i) {
    world.bearings_b[i] =
        WithNoise(random, BearingOf(world.b_from_a, world.points_in_a[i]), kSigmaRad);
  }
  AddRoof(300, world);
  const TwoViewGeometry geometry = Estimate(world);
  EXPECT_EQ(geometry.kind, TwoViewKind::kGeneral);
  EXPECT_EQ(geometry.num_putative, 400U);
  EXPECT_LT(RotationError(geometry.b_from_a.rotation, world.b_from_a.rotation), 1e-3);
  EXPECT_LT(DirectionError(geometry, world), 0.01);
  for (const FeatureMatch& match : geometry.inliers) EXPECT_LT(match.a, 100U);
}

/// Houses far to all sides of a crossing, seen up to ten degrees above the horizon.
TwoViewWorld MakeCrossing(size_t count) {
  TwoViewWorld world;
  world.b_from_a =
      Rigid3::FromCentre(RotationFromVector({0.01, 0.1, -0.02}), Vector3d(0.0, 0.0, 6.0));
  world.b_from_a.translation.normalize();
  Random random(9);
  for (size_t i = 0; i < count; ++i) {
    const double azimuth = random.Uniform(-3.14, 3.14);
    const double range = random.Uniform(15.0, 40.0);
    const Vector3d X(
        range * std::sin(azimuth), random.Uniform(-0.17, 0.05) * range, range * std::cos(azimuth));
    world.bearings_a.push_back(WithNoise(random, X.normalized(), kSigmaRad));
    world.bearings_b.push_back(WithNoise(random, BearingOf(world.b_from_a, X / 6.0), kSigmaRad));
  }
  return world;
}

TEST(EstimateTwoView, IsNotMisledByARoofThatCoversMoreThanTheScene) {
  TwoViewWorld world = MakeCrossing(150);
  AddRoof(400, world, kBelow25Degrees);
  const TwoViewGeometry geometry = Estimate(world);
  EXPECT_EQ(geometry.kind, TwoViewKind::kGeneral);
  EXPECT_LT(RotationError(geometry.b_from_a.rotation, world.b_from_a.rotation), 2e-3);
  EXPECT_LT(DirectionError(geometry, world), 0.05);
  for (const FeatureMatch& match : geometry.inliers) EXPECT_LT(match.a, 150U);
}

TEST(EstimateTwoView, KnowsNothingOfAPairInWhichOnlyTheCarrierMatches) {
  TwoViewWorld world;
  AddRoof(200, world);
  const TwoViewGeometry geometry = Estimate(world);
  EXPECT_EQ(geometry.kind, TwoViewKind::kNone);
  EXPECT_EQ(geometry.num_putative, 200U);
}

TEST(EstimateTwoView, KeepsTheRotationOfACameraThatStandsWhenABusDrivesBy) {
  TwoViewWorld world;
  Random random(8);
  for (int i = 0; i < 150; ++i) {
    const Vector3d ray = RandomDirection(random);
    world.bearings_a.push_back(WithNoise(random, ray, kSigmaRad));
    world.bearings_b.push_back(WithNoise(random, ray, kSigmaRad));
  }
  for (int i = 0; i < 60; ++i) {  // beside the camera, and two metres on
    const Vector3d X(random.Uniform(2.0, 4.0), random.Uniform(-2.0, 1.0), random.Uniform(-3, 3));
    world.bearings_a.push_back(WithNoise(random, X.normalized(), kSigmaRad));
    world.bearings_b.push_back(
        WithNoise(random, (X + Vector3d(0.0, 0.0, 2.0)).normalized(), kSigmaRad));
  }
  const TwoViewGeometry geometry = Estimate(world);
  EXPECT_LT(RotationError(geometry.b_from_a.rotation, Eigen::Quaterniond::Identity()), 1e-3);
  EXPECT_GE(geometry.inliers.size(), 145U);
}

/// A camera that goes 8 m down a street: facades 8 m to both sides from the ground to 12 m up.
TwoViewWorld MakeStreet(uint64_t seed, size_t count) {
  Random random(seed);
  TwoViewWorld world;
  world.b_from_a = Rigid3::FromCentre(RotationFromVector({0.01, random.Uniform(-0.3, 0.3), -0.02}),
                                      Vector3d(0.0, 0.0, 8.0));
  world.b_from_a.translation.normalize();
  for (size_t i = 0; i < count; ++i) {
    const Vector3d X(random.Uniform() < 0.5 ? -8.0 : 8.0,
                     random.Uniform(-12.0, 2.0),
                     random.Uniform(-20.0, 28.0));
    world.points_in_a.push_back(X / 8.0);
    world.bearings_a.push_back(WithNoise(random, X.normalized(), kSigmaRad));
    world.bearings_b.push_back(WithNoise(random, BearingOf(world.b_from_a, X / 8.0), kSigmaRad));
  }
  return world;
}

/// Clouds in a layer, which have gone by `drift` of its height between the two panoramas.
void AddClouds(size_t count, const Vector3d& drift, TwoViewWorld& world) {
  Random random(78);
  for (size_t i = 0; i < count; ++i) {
    const Vector3d X(random.Uniform(-2.0, 2.0), -1.0, random.Uniform(-2.0, 2.0));
    world.bearings_a.push_back(WithNoise(random, X.normalized(), kSigmaRad));
    world.bearings_b.push_back(
        WithNoise(random, (world.b_from_a.rotation * (X + drift)).normalized(), kSigmaRad));
  }
}

TEST(EstimateTwoView, IsNotMisledByCloudsThatMatchMoreThanTheScene) {
  // 0.005 is hardly more than agreeing allows: most of the clouds seem to stand.
  for (const double drift : {0.0, 0.005, 0.01, 0.05, 0.08}) {
    for (uint64_t seed = 0; seed < 10; ++seed) {
      TwoViewWorld world = MakeStreet(seed, 100);
      AddClouds(300, drift * Vector3d(0.8, 0.0, 0.6), world);
      const TwoViewGeometry geometry = Estimate(world);
      EXPECT_EQ(geometry.kind, TwoViewKind::kGeneral) << drift << " " << seed;
      EXPECT_LT(RotationError(geometry.b_from_a.rotation, world.b_from_a.rotation), 1e-3);
      EXPECT_LT(DirectionError(geometry, world), 5e-3) << drift << " " << seed;
      const auto scene = std::ranges::count_if(
          geometry.inliers, [](const FeatureMatch& match) { return match.a < 100; });
      EXPECT_GT(scene, 90) << drift << " " << seed;
      if (drift > 0.0) {  // what stands still may stay
        EXPECT_LT(static_cast<double>(geometry.inliers.size()), 1.2 * static_cast<double>(scene));
      }
      EXPECT_EQ(geometry.num_putative, 400U);
    }
  }
}

/// Adds matches of the facade on the right whose windows repeat: each with the one `period_m` on.
void AddAliases(size_t count, double period_m, TwoViewWorld& world) {
  Random random(79);
  for (size_t i = 0; i < count; ++i) {
    const Vector3d X(8.0, random.Uniform(-12.0, 2.0), random.Uniform(0.0, 14.0));
    const Vector3d alias = X + Vector3d(0.0, 0.0, period_m);
    world.bearings_a.push_back(WithNoise(random, X.normalized(), kSigmaRad));
    world.bearings_b.push_back(
        WithNoise(random, BearingOf(world.b_from_a, alias / 8.0), kSigmaRad));
  }
}

TEST(EstimateTwoView, IsNotMisledByAFacadeWhoseWindowsRepeat) {
  for (const double period_m : {11.0, 14.0}) {
    for (uint64_t seed = 0; seed < 10; ++seed) {
      TwoViewWorld world = MakeStreet(seed, 100);
      AddAliases(250, period_m, world);
      const TwoViewGeometry geometry = Estimate(world);
      EXPECT_EQ(geometry.kind, TwoViewKind::kGeneral) << period_m << " " << seed;
      EXPECT_LT(RotationError(geometry.b_from_a.rotation, world.b_from_a.rotation), 2e-3);
      EXPECT_LT(DirectionError(geometry, world), 1e-2) << period_m << " " << seed;
    }
  }
}

TEST(EstimateTwoView, BelievesAFacadeThatNothingElseContradicts) {
  TwoViewWorld world = MakeStreet(4, 12);
  AddAliases(250, 0.0, world);
  Random random(80);
  for (int i = 0; i < 150; ++i) {
    world.bearings_a.push_back(RandomDirection(random));
    world.bearings_b.push_back(RandomDirection(random));
  }
  const TwoViewGeometry geometry = Estimate(world);
  EXPECT_GT(geometry.inliers.size(), 240U);
  EXPECT_LT(DirectionError(geometry, world), 1e-2);
}

/// With features of a street below that have no match; all others have.
TwoViewGeometry EstimateBesideAStreet(TwoViewWorld sky, size_t street_features) {
  const auto num_matches = static_cast<uint32_t>(sky.bearings_a.size());
  const TwoViewWorld street = MakeStreet(4, street_features);
  sky.bearings_a.insert(sky.bearings_a.end(), street.bearings_a.begin(), street.bearings_a.end());
  sky.bearings_b.insert(sky.bearings_b.end(), street.bearings_b.begin(), street.bearings_b.end());
  const auto geometry = EstimateTwoView(kPair,
                                        sky.bearings_a,
                                        sky.bearings_b,
                                        MatchesInOrder(num_matches),
                                        kMaxErrorRad,
                                        {},
                                        {.seed = 1});
  EXPECT_TRUE(geometry.ok()) << geometry.status();
  EXPECT_EQ(geometry->num_putative, num_matches);
  return *geometry;
}

TEST(EstimateTwoView, KnowsNothingOfAPairInWhichOnlyTheSkyMatches) {
  for (const double drift : {0.0, 0.02, 0.08}) {
    TwoViewWorld world = MakeStreet(3, 0);
    AddClouds(300, drift * Vector3d(0.8, 0.0, 0.6), world);
    EXPECT_EQ(EstimateBesideAStreet(world, 300).kind, TwoViewKind::kNone) << drift;
  }
}

TEST(EstimateTwoView, KnowsNothingWhereTheSkyMatchesInTwoWays) {
  TwoViewWorld world = MakeStreet(3, 0);
  AddClouds(300, Vector3d(0.05, 0.0, 0.0), world);
  AddClouds(200, Vector3d(0.0, 0.0, 0.07), world);
  EXPECT_EQ(EstimateBesideAStreet(world, 900).kind, TwoViewKind::kNone);
}

TEST(EstimateTwoView, TakesWhatIsHighForTheSceneWhereNothingElseIsSeen) {
  TwoViewWorld world = MakeStreet(3, 0);
  AddClouds(300, Vector3d(0.02, 0.0, 0.0), world);
  EXPECT_NE(Estimate(world).kind, TwoViewKind::kNone);
}

TEST(EstimateTwoView, KeepsAllMatchesOfACameraThatStandsUnderAHighCeiling) {
  TwoViewWorld world = MakeStreet(5, 0);
  AddClouds(300, Vector3d::Zero(), world);
  Random random(9);
  for (int i = 0; i < 60; ++i) {
    const Vector3d ray(random.Uniform(-1.0, 1.0), random.Uniform(0.0, 0.5), 1.0);
    world.bearings_a.push_back(WithNoise(random, ray.normalized(), kSigmaRad));
    world.bearings_b.push_back(
        WithNoise(random, world.b_from_a.rotation * ray.normalized(), kSigmaRad));
  }
  const TwoViewGeometry geometry = Estimate(world);
  EXPECT_EQ(geometry.kind, TwoViewKind::kPureRotation);
  EXPECT_GT(geometry.inliers.size(), 345U);
}

}  // namespace
}  // namespace orbweave
