// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/join_components.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/estimators/compare_poses.h"
#include "core/geometry/rotation.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

constexpr uint32_t kFirstOfSecond = 20;

/// Images of one component, with tracks that they alone see, in a frame of its own.
Reconstruction Part(const Reconstruction& model,
                    uint32_t first,
                    uint32_t end,
                    const Sim3& part_from_world) {
  Reconstruction part;
  const auto is_in = [&](ImageId id) { return id.value >= first && id.value < end; };
  for (const auto& [id, image] : model.images) {
    if (is_in(id)) part.images.emplace(id, image);
  }
  for (Track track : model.tracks) {
    std::erase_if(track.observations,
                  [&](const Observation& seen) { return !is_in(seen.ref.image); });
    if (track.observations.size() >= 2) part.tracks.push_back(std::move(track));
  }
  return Transformed(part_from_world, std::move(part));
}

/// A street of 40 panoramas that was reconstructed in two components.
class BrokenStreet {
 public:
  BrokenStreet()
      : corridor_(MakeCorridor({.panoramas = 40, .features_per_panorama = 200, .seed = 3})) {
    const Reconstruction model = testing::TrueModel(corridor_);
    const Sim3 second{0.37, RotationFromVector({0.4, -1.1, 0.7}), {3.0, -8.0, 1.0}};
    components = {Part(model, 0, kFirstOfSecond, {}), Part(model, kFirstOfSecond, 40, second)};
    for (const Features& features : corridor_.features) {
      std::vector<Eigen::Vector3d>& bearings = bearings_.emplace_back();
      for (FeatureIndex f = 0; f < features.size(); ++f) bearings.push_back(features.Bearing(f));
    }
    for (uint32_t i = 0; i < 40; ++i)
      rays.push_back({ImageId(i), bearings_[i], corridor_.features[i].sigma_rad});
  }

  /// Verified pairs between both components with their matches, wrong ones among them.
  [[nodiscard]] std::vector<TwoViewGeometry> PairsAcross() const {
    std::vector<TwoViewGeometry> pairs;
    for (const PairMatches& pair : corridor_.pairs) {
      if (pair.pair.a.value >= kFirstOfSecond || pair.pair.b.value < kFirstOfSecond) continue;
      pairs.push_back({.pair = pair.pair, .kind = TwoViewKind::kGeneral, .inliers = pair.matches});
    }
    return pairs;
  }

  [[nodiscard]] std::vector<Reconstruction> Join(const std::vector<TwoViewGeometry>& pairs) const {
    const auto joined = JoinComponents(components, rays, pairs, {}, {.seed = 5});
    EXPECT_TRUE(joined.ok()) << joined.status();
    return joined.ok() ? *joined : std::vector<Reconstruction>();
  }

  [[nodiscard]] double ErrorOf(const Reconstruction& model) const {
    std::vector<Rigid3> estimated;
    std::vector<Rigid3> truth;
    for (const auto& [id, image] : model.images) {
      estimated.push_back(image.cam_from_world);
      truth.push_back(corridor_.cams_from_world[id.value]);
    }
    return ComparePoses(estimated, truth)
        .value_or(PoseErrors{.position_rmse_m = 1e9})
        .position_rmse_m;
  }

  std::vector<Reconstruction> components{};
  std::vector<ImageRays> rays{};

 private:
  Corridor corridor_;
  std::vector<std::vector<Eigen::Vector3d>> bearings_;
};

TEST(JoinComponents, MakesOneOfTwoPartsThatPairsHoldTogether) {
  const BrokenStreet street;
  const std::vector<Reconstruction> joined = street.Join(street.PairsAcross());
  ASSERT_EQ(joined.size(), 1U);
  EXPECT_EQ(joined[0].images.size(), 40U);
  EXPECT_LT(street.ErrorOf(joined[0]), 0.05);
  const auto spans_both = [](const Track& track) {
    return track.observations.front().ref.image.value < kFirstOfSecond &&
           track.observations.back().ref.image.value >= kFirstOfSecond;
  };
  EXPECT_GT(std::ranges::count_if(joined[0].tracks, spans_both), 50);
}

TEST(JoinComponents, LeavesApartWhatASinglePairWouldJoin) {
  const BrokenStreet street;
  std::vector<TwoViewGeometry> pairs = street.PairsAcross();
  std::erase_if(pairs, [](const TwoViewGeometry& pair) {
    return pair.pair.a.value != kFirstOfSecond - 1 || pair.pair.b.value != kFirstOfSecond;
  });
  ASSERT_EQ(pairs.size(), 1U);
  const std::vector<Reconstruction> joined = street.Join(pairs);
  ASSERT_EQ(joined.size(), 2U);
  for (size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(joined[c].images.size(), 20U);
    EXPECT_EQ(joined[c].NumObservations(), street.components[c].NumObservations());
  }
}

TEST(JoinComponents, LeavesApartWhatPairsContradict) {
  const BrokenStreet street;
  std::vector<TwoViewGeometry> pairs = street.PairsAcross();
  for (TwoViewGeometry& pair : pairs) {
    for (size_t i = 0; i + 1 < pair.inliers.size(); ++i)
      std::swap(pair.inliers[i].b, pair.inliers[(i * 7 + 3) % pair.inliers.size()].b);
  }
  EXPECT_EQ(street.Join(pairs).size(), 2U);
  EXPECT_EQ(street.Join({}).size(), 2U);
}

}  // namespace
}  // namespace orbweave
