// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/split_by_gnss.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;

constexpr uint32_t kImages = 12;

/// A street of images 8 m apart with GNSS of 2 m, three of which in a row see a point together.
struct Street {
  ClusterProblem problem{};
  Reconstruction model{};

  Street() {
    for (uint32_t i = 0; i < kImages; ++i) {
      problem.images.push_back({.id = ImageId(i)});
      PosePrior& prior = problem.images.back().prior;
      prior.position_in_enu = Eigen::Vector3d(8.0 * i, 0.0, 0.0);
      prior.horizontal_sigma_m = 2.0;
      MoveTo(i, *prior.position_in_enu);
    }
    for (uint32_t i = 0; i + 2 < kImages; ++i) {
      Track& track = model.tracks.emplace_back();
      for (uint32_t k = 0; k < 3; ++k)
        track.observations.push_back({.ref = {ImageId(i + k), FeatureIndex{i}}});
    }
    model.SortTracks();
  }

  void MoveTo(uint32_t image, const Eigen::Vector3d& centre) {
    model.images[ImageId(image)].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), centre);
  }
  [[nodiscard]] Eigen::Vector3d CentreOf(uint32_t image) const {
    return model.images.at(ImageId(image)).cam_from_world.Centre();
  }
  void MoveFrom(uint32_t first, const Eigen::Vector3d& by) {
    for (uint32_t i = first; i < kImages; ++i) MoveTo(i, CentreOf(i) + by);
  }
  [[nodiscard]] std::vector<size_t> Sizes() const {
    std::vector<size_t> sizes;
    for (const Reconstruction& piece : SplitByGnss(problem, model))
      sizes.push_back(piece.images.size());
    return sizes;
  }
};

TEST(SplitByGnss, LeavesAStreetThatIsWholeAsItIs) {
  const Street street;
  const std::vector<Reconstruction> pieces = SplitByGnss(street.problem, street.model);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].tracks.size(), street.model.tracks.size());
}

TEST(SplitByGnss, PartsWhatStandsFarTooFarApart) {
  Street street;
  street.MoveFrom(7, {500.0, 300.0, 0.0});
  const std::vector<Reconstruction> pieces = SplitByGnss(street.problem, street.model);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].images.size(), 7U);
  EXPECT_EQ(pieces[1].images.size(), 5U);
  for (const Reconstruction& piece : pieces) {
    for (const Track& track : piece.tracks) {
      EXPECT_GE(track.observations.size(), 2U);
      for (const Observation& seen : track.observations)
        EXPECT_TRUE(piece.images.contains(seen.ref.image));
    }
  }
  EXPECT_EQ(pieces[0].tracks.size(), 6U);  // 0 to 4 whole, 5 by two of its images
  EXPECT_EQ(pieces[1].tracks.size(), 4U);
}

TEST(SplitByGnss, DoesNotDependOnTheModelsFrame) {
  Street street;
  street.MoveFrom(7, {500.0, 300.0, 0.0});
  const Eigen::Quaterniond turn = RotationFromVector({0.3, -1.0, 2.0});
  for (uint32_t i = 0; i < kImages; ++i)
    street.MoveTo(i, 0.01 * (turn * street.CentreOf(i)) + Eigen::Vector3d(3.0, 2.0, 1.0));
  EXPECT_THAT(street.Sizes(), ElementsAre(7, 5));
}

TEST(SplitByGnss, OneImageFlungOutIsAPieceByItself) {
  Street street;
  street.MoveTo(5, {40.0, 400.0, 0.0});
  EXPECT_THAT(street.Sizes(), ElementsAre(11, 1));
}

TEST(SplitByGnss, WhatIsNotFarOffIsForTheOthersToJudge) {
  Street street;
  street.MoveFrom(7, {12.0, 0.0, 0.0});
  EXPECT_THAT(street.Sizes(), ElementsAre(12));
}

TEST(SplitByGnss, PositionsThatAreOffTearNothing) {
  Street street;
  street.problem.images[5].prior.position_in_enu = Eigen::Vector3d(300.0, -80.0, 0.0);
  street.problem.images[6].prior.position_in_enu = street.problem.images[4].prior.position_in_enu;
  EXPECT_THAT(street.Sizes(), ElementsAre(12));
}

TEST(SplitByGnss, NeedsPositions) {
  Street street;
  street.MoveFrom(7, {500.0, 300.0, 0.0});
  for (ClusterImage& image : street.problem.images) image.prior.position_in_enu.reset();
  EXPECT_THAT(street.Sizes(), ElementsAre(12));
  EXPECT_EQ(SplitByGnss({}, {}).size(), 1U);
}

}  // namespace
}  // namespace orbweave
