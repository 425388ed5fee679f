// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/bridges/find_bridge.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "tests/core/mapping/broken_street.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

double WorstCentre(const Sim3& found, const MappingState& second) {
  double worst = 0.0;
  for (const ImageSlot image : second.Registered()) {
    const Vector3d& C = second.Centre(image);
    worst = std::max(worst, (found * C - BrokenStreet::TrueAFromB() * C).norm());
  }
  return worst;
}

TEST(FindBridge, CarriesOnOverOnePairWithGnss) {
  const BrokenStreet street({.pairs_between = 1});
  const MappingState second = street.Second();
  const auto found = FindBridge(street.First(), second, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(WorstCentre(*found, second), 1.0);  // of 90 m
}

TEST(FindBridge, IsTheInverseOfTheOneBack) {
  const BrokenStreet street({.pairs_between = 2});
  const MappingState first = street.First();
  const auto back = FindBridge(street.Second(), first, {});
  ASSERT_TRUE(back.has_value());
  EXPECT_LT(WorstCentre(back->Inverse(), street.Second()), 1.0);
}

TEST(FindBridge, NeedsThreePairsWithoutGnss) {
  const BrokenStreet one({.has_gnss = false, .pairs_between = 1});
  EXPECT_FALSE(FindBridge(one.First(), one.Second(), {}).has_value());
  const BrokenStreet five({.has_gnss = false, .pairs_between = 5});
  const MappingState second = five.Second();
  const auto found = FindBridge(five.First(), second, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(WorstCentre(*found, second), 1.0);
}

TEST(FindBridge, DoesNotMindHowPanoramasAreTurned) {
  const BrokenStreet street({.has_gnss = false, .random_rotations = true, .pairs_between = 5});
  const MappingState second = street.Second();
  const auto found = FindBridge(street.First(), second, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(WorstCentre(*found, second), 1.0);
}

TEST(FindBridge, RefusesWhatGnssContradicts) {
  BrokenStreet street({.pairs_between = 5});
  for (uint32_t i = BrokenStreet::kFirstOfSecond; i < BrokenStreet::kImages; ++i)
    *street.World().problem.images[i].prior.position_in_enu += Vector3d(0.0, 40.0, 0.0);
  EXPECT_FALSE(FindBridge(street.First(), street.Second(), {}).has_value());
}

TEST(FindBridge, RefusesPairsThatContradictEachOther) {
  BrokenStreet street({.has_gnss = false, .pairs_between = 5});
  Random random(1);
  for (TwoViewGeometry& pair : street.World().problem.pairs) {
    if (!BrokenStreet::IsBetween(pair)) continue;
    pair.b_from_a.rotation = street_internal::RandomRotation(random);
  }
  EXPECT_FALSE(FindBridge(street.First(), street.Second(), {}).has_value());
}

TEST(FindBridge, RefusesPairsThatNoPointAgreesWith) {
  BrokenStreet street({.pairs_between = 3});
  for (TwoViewGeometry& pair : street.World().problem.pairs) {
    if (!BrokenStreet::IsBetween(pair)) continue;
    for (size_t i = 0; i + 1 < pair.inliers.size(); ++i)
      std::swap(pair.inliers[i].b, pair.inliers[(i * 7 + 3) % pair.inliers.size()].b);
  }
  street.Rebuild();
  EXPECT_FALSE(FindBridge(street.First(), street.Second(), {}).has_value());
}

/// A street of which images 10 to 13 are a model of their own. Of the pairs that lead there those
/// of `ends` are left, and no point that they see is where they see it.
class HeldPiece {
 public:
  explicit HeldPiece(const std::set<std::pair<uint32_t, uint32_t>>& ends) {
    const auto is_in_piece = [](ImageId id) { return id.value >= 10 && id.value <= 13; };
    std::vector<TwoViewGeometry>& pairs = street_.World().problem.pairs;
    std::erase_if(pairs, [&](const TwoViewGeometry& pair) {
      return is_in_piece(pair.pair.a) != is_in_piece(pair.pair.b) &&
             !ends.contains({pair.pair.a.value, pair.pair.b.value});
    });
    for (TwoViewGeometry& pair : pairs) {
      if (is_in_piece(pair.pair.a) == is_in_piece(pair.pair.b)) continue;
      for (size_t i = 0; i + 1 < pair.inliers.size(); ++i)
        std::swap(pair.inliers[i].b, pair.inliers[(i * 7 + 3) % pair.inliers.size()].b);
    }
    street_.Rebuild();
  }

  [[nodiscard]] BrokenStreet& Street() { return street_; }
  [[nodiscard]] MappingState Piece() const {
    return street_.Part(10, 14, BrokenStreet::TrueAFromB().Inverse());
  }
  [[nodiscard]] MappingState Rest() const {
    MappingState rest = street_.Part(0, 10, {});
    const MappingState behind = street_.Part(14, BrokenStreet::kImages, {});
    for (const ImageSlot image : behind.Registered()) {
      rest.Register(image, behind.CamFromWorld(image));
      TriangulateImage(rest, image, TrackLimits{});
    }
    return rest;
  }

 private:
  BrokenStreet street_{{.pairs_between = 1000}};
};

TEST(FindBridge, HoldsAPieceByItsTwoEndsAlone) {
  const HeldPiece held({{9, 10}, {13, 14}});
  const MappingState piece = held.Piece();
  const auto found = FindBridge(held.Rest(), piece, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(WorstCentre(*found, piece), 1.5);
}

TEST(FindBridge, DoesNotHoldAPieceByOneEndAlone) {
  const HeldPiece held({{9, 10}, {8, 11}});
  EXPECT_FALSE(FindBridge(held.Rest(), held.Piece(), {}).has_value());
}

TEST(FindBridge, DoesNotHoldAPieceByItsTwoEndsWhereGnssIsSilentOrAgainstIt) {
  HeldPiece silent({{9, 10}, {13, 14}});
  for (ClusterImage& image : silent.Street().World().problem.images)
    image.prior.position_in_enu.reset();
  EXPECT_FALSE(FindBridge(silent.Rest(), silent.Piece(), {}).has_value());
  HeldPiece contradicted({{9, 10}, {13, 14}});
  for (uint32_t i = 10; i < 14; ++i) {
    *contradicted.Street().World().problem.images[i].prior.position_in_enu +=
        Vector3d(0.0, 40.0, 0.0);
  }
  EXPECT_FALSE(FindBridge(contradicted.Rest(), contradicted.Piece(), {}).has_value());
}

TEST(FindBridge, FindsNothingWhereNothingIs) {
  const BrokenStreet street({.pairs_between = 1});
  EXPECT_FALSE(FindBridge(street.Part(0, 6, {}), street.Second(), {}).has_value());
}

}  // namespace
}  // namespace orbweave
