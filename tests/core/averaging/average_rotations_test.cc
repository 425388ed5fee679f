// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/average_rotations.h"

#include <gtest/gtest.h>

#include "tests/core/averaging/rotation_samples.h"

namespace orbweave {
namespace {

using testing::MakeRotationStreet;
using testing::RotationStreet;
using testing::WorstRotation;

AveragedRotations Averaged(const RotationStreet& street) {
  const auto averaged = AverageRotations(street.graph, {});
  EXPECT_TRUE(averaged.ok()) << averaged.status();
  return averaged.ok() ? *averaged : AveragedRotations{};
}

TEST(AverageRotations, RecoversExactRotations) {
  const RotationStreet street = MakeRotationStreet({});
  const AveragedRotations averaged = Averaged(street);
  EXPECT_LT(WorstRotation(street.cam_from_world, averaged.cam_from_world), 1e-10);
  for (const double error : averaged.error_rad) EXPECT_LT(error, 1e-10);
}

TEST(AverageRotations, TakesTheFrameOfTheFirstImage) {
  const AveragedRotations averaged = Averaged(MakeRotationStreet({.noise_rad = 0.01}));
  EXPECT_EQ(averaged.cam_from_world[0].coeffs(), Eigen::Quaterniond::Identity().coeffs());
}

TEST(AverageRotations, DoesNotDependOnHowTheWorldIsTurned) {
  // Turning the world leaves every measurement as it is; turning each image by its own
  // rotation turns its result alone.
  RotationStreet street = MakeRotationStreet({.noise_rad = 0.01, .outlier_share = 0.1});
  const AveragedRotations before = Averaged(street);
  Random random(7);
  std::vector<Eigen::Quaterniond> turn;
  for (size_t i = 0; i < street.cam_from_world.size(); ++i) {
    turn.push_back(testing::RandomRotation(random));
  }
  for (ViewEdge& edge : street.graph.edges) {
    edge.b_from_a.rotation =
        turn[edge.pair.b.value] * edge.b_from_a.rotation * turn[edge.pair.a.value].conjugate();
  }
  const AveragedRotations after = Averaged(street);
  std::vector<Eigen::Quaterniond> expected;
  for (size_t i = 0; i < turn.size(); ++i) {
    expected.push_back(turn[i] * before.cam_from_world[i]);
  }
  EXPECT_LT(WorstRotation(expected, after.cam_from_world), 1e-4);
}

TEST(AverageRotations, StaysNearTheTruthWithNoise) {
  // Averaging over a window beats the chain of single measurements, sqrt(40) of them at the end.
  const double noise_rad = 1e-3;
  const RotationStreet street = MakeRotationStreet({.noise_rad = noise_rad});
  EXPECT_LT(WorstRotation(street.cam_from_world, Averaged(street).cam_from_world), 4.0 * noise_rad);
}

TEST(AverageRotations, IsNotLedAstrayByAFifthOfWrongEdges) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const RotationStreet exact =
        MakeRotationStreet({.window = 10, .outlier_share = 0.2, .seed = seed});
    EXPECT_LT(WorstRotation(exact.cam_from_world, Averaged(exact).cam_from_world), 1e-6) << seed;
    const RotationStreet noisy =
        MakeRotationStreet({.window = 10, .noise_rad = 1e-3, .outlier_share = 0.2, .seed = seed});
    EXPECT_LT(WorstRotation(noisy.cam_from_world, Averaged(noisy).cam_from_world), 1e-2) << seed;
  }
}

TEST(AverageRotations, TellsWhichEdgesAreWrong) {
  RotationStreet street = MakeRotationStreet({.noise_rad = 1e-3});
  Eigen::Quaterniond& wrong = street.graph.edges[17].b_from_a.rotation;
  wrong = RotationFromVector(Eigen::Vector3d(0.0, 0.5, 0.0)) * wrong;
  const AveragedRotations averaged = Averaged(street);
  for (size_t e = 0; e < street.graph.edges.size(); ++e) {
    if (e == 17) {
      EXPECT_NEAR(averaged.error_rad[e], 0.5, 0.02);
    } else {
      EXPECT_LT(averaged.error_rad[e], 0.01);
    }
  }
}

TEST(AverageRotations, KeepsPartsApart) {
  RotationStreet street = MakeRotationStreet({.images = 12, .window = 3});
  std::erase_if(street.graph.edges, [](const ViewEdge& edge) {
    return edge.pair.a.value < 5 && edge.pair.b.value >= 5;
  });
  const AveragedRotations averaged = Averaged(street);
  EXPECT_EQ(averaged.cam_from_world[5].coeffs(), Eigen::Quaterniond::Identity().coeffs());
  for (const double error : averaged.error_rad) EXPECT_LT(error, 1e-10);
}

TEST(AverageRotations, ImagesWithoutEdgesStay) {
  const auto averaged = AverageRotations({.num_images = 3}, {});
  ASSERT_TRUE(averaged.ok());
  EXPECT_EQ(averaged->cam_from_world.size(), 3U);
  EXPECT_TRUE(averaged->error_rad.empty());
}

TEST(AverageRotations, IsCancelledWhenAskedToStop) {
  std::stop_source source;
  source.request_stop();
  const RotationStreet street = MakeRotationStreet({});
  EXPECT_EQ(AverageRotations(street.graph, {.stop = source.get_token()}).status().code(),
            absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
