// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/image_support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "core/geometry/rotation.h"
#include "core/geometry/sphere_cells.h"
#include "core/synthetic/make_corridor.h"
#include "tests/core/merging/adjust_globally.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

using testing::AdjustGlobally;
using testing::GloballyAdjusted;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::TrueModel;

constexpr ImageId kImage{9};

Corridor Street(int features = 200) {
  return MakeCorridor({.panoramas = 20, .features_per_panorama = features, .gnss_sigma_m = 0.0});
}

GloballyAdjusted Adjust(const Reconstruction& model, const Corridor& corridor) {
  return AdjustGlobally(model, corridor.manifest, {}, {}, {}).value();
}

void ForEachObservation(Reconstruction& model,
                        ImageId id,
                        const std::function<void(Track&, Observation&)>& visit) {
  for (Track& track : model.tracks) {
    for (Observation& seen : track.observations) {
      if (seen.ref.image == id) visit(track, seen);
    }
  }
}

/// Leaves `image` the first observations that `keeps`, and what else is seen twice or more.
void Keep(Reconstruction& model, const std::function<bool(const Observation&)>& keeps) {
  for (Track& track : model.tracks) {
    std::erase_if(track.observations, [&](const Observation& seen) {
      return seen.ref.image == kImage && !keeps(seen);
    });
  }
  std::erase_if(model.tracks, [](const Track& track) { return track.observations.size() < 2; });
  model.SortTracks();
}

/// Puts the image elsewhere, and its bearings to where its points are from there.
void Misplace(Reconstruction& model, const Eigen::Vector3d& by) {
  Rigid3& pose = model.images.at(kImage).cam_from_world;
  pose = Rigid3::FromCentre(pose.rotation, pose.Centre() + by);
  ForEachObservation(model, kImage, [&](Track& track, Observation& seen) {
    seen.bearing = (pose * track.point_in_world).normalized();
  });
}

/// The patch of the image in which most is seen.
uint32_t FullestPatch(Reconstruction& model) {
  std::map<uint32_t, int> counts;
  ForEachObservation(model, kImage, [&](Track&, Observation& seen) {
    ++counts[SphereCell(seen.bearing, kSupportBands)];
  });
  return std::ranges::max_element(counts, {}, [](const auto& each) { return each.second; })->first;
}

TEST(JudgeSupport, FindsEveryImageOfATrueStreetPlaced) {
  const Corridor corridor = Street(100);
  const GloballyAdjusted adjusted = Adjust(TrueModel(corridor), corridor);
  EXPECT_THAT(adjusted.report.weak_images, IsEmpty());
  EXPECT_EQ(adjusted.reconstruction.images.size(), 20U);
}

TEST(JudgeSupport, TakesOutAnImageThatEightObservationsInOneCornerPlaceElsewhere) {
  const Corridor corridor = Street();
  Reconstruction model = TrueModel(corridor);
  Misplace(model, {1.0, 5.0, 0.5});
  const uint32_t corner = FullestPatch(model);
  int left = 8;
  Keep(model, [&](const Observation& seen) {
    return SphereCell(seen.bearing, kSupportBands) == corner && left-- > 0;
  });
  const GloballyAdjusted adjusted = Adjust(model, corridor);
  ASSERT_EQ(adjusted.report.weak_images.size(), 1U);
  EXPECT_EQ(adjusted.report.weak_images[0].name, corridor.manifest.At(kImage).name);
  EXPECT_THAT(adjusted.report.weak_images[0].reason, HasSubstr("8 observations"));
  EXPECT_FALSE(adjusted.reconstruction.images.contains(kImage));
  for (const Track& track : adjusted.reconstruction.tracks) {
    EXPECT_GE(track.observations.size(), 2U);
    for (const Observation& seen : track.observations) EXPECT_NE(seen.ref.image, kImage);
  }
}

TEST(JudgeSupport, WhatItTakesOutSaysNothingOfGnss) {
  Corridor corridor = Street();
  for (ImageRecord& image : corridor.manifest.images) {
    image.prior.position_in_enu = corridor.cams_from_world[image.id.value].Centre();
    image.prior.horizontal_sigma_m = image.prior.vertical_sigma_m = 0.5;
  }
  Reconstruction model = TrueModel(corridor);
  int left = 8;
  Keep(model, [&](const Observation&) { return left-- > 0; });
  *corridor.manifest.images[kImage.value].prior.position_in_enu += Eigen::Vector3d(40.0, 25.0, 0.0);
  const GloballyAdjusted adjusted = Adjust(model, corridor);
  ASSERT_EQ(adjusted.report.weak_images.size(), 1U);
  EXPECT_TRUE(adjusted.report.gnss.used) << adjusted.report.gnss.reason;
  EXPECT_THAT(adjusted.report.gnss.outliers, IsEmpty());
  EXPECT_EQ(adjusted.report.gnss.num_priors, 19U);
  EXPECT_EQ(adjusted.report.gnss.num_inliers, 19U);
}

TEST(JudgeSupport, TakesOutWhatOneBusAndAFewStrayMatchesPlace) {
  const Corridor corridor = Street(600);
  Reconstruction model = TrueModel(corridor);
  Misplace(model, {4.0, 0.0, 0.0});
  const uint32_t bus = FullestPatch(model);
  int strays = 4;
  Keep(model, [&](const Observation& seen) {
    return SphereCell(seen.bearing, kSupportBands) == bus || strays-- > 0;
  });
  const GloballyAdjusted adjusted = Adjust(model, corridor);
  ASSERT_EQ(adjusted.report.weak_images.size(), 1U);
  EXPECT_THAT(adjusted.report.weak_images[0].reason, HasSubstr("in one corner"));
}

TEST(JudgeSupport, KeepsAnImageThatTwentyObservationsAllRoundPlace) {
  const Corridor corridor = Street();
  Reconstruction model = TrueModel(corridor);
  int every = 0;
  Keep(model, [&](const Observation&) { return every++ % 10 == 0; });
  int kept = 0;
  ForEachObservation(model, kImage, [&](Track&, Observation&) { ++kept; });
  ASSERT_NEAR(kept, 20, 6);
  const GloballyAdjusted adjusted = Adjust(model, corridor);
  EXPECT_THAT(adjusted.report.weak_images, IsEmpty());
}

TEST(JudgeSupport, NeedsMoreThanTheEpipolarPlanesOfOneOtherImage) {
  // Pairs alone leave the distance between two images open.
  std::vector<PatchSupport> patches;
  Random random(3);
  Subproblem subproblem;
  subproblem.scene.images[ImageId(0)] = {};
  subproblem.scene.images[ImageId(1)] = {
      .cam_from_world = Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0})};
  for (FeatureIndex f = 0; f < 300; ++f) {
    Track track{.point_in_world = 5.0 * testing::RandomDirection(random)};
    for (const auto& [id, image] : subproblem.scene.images) {
      track.observations.push_back(
          {.ref = {id, f}, .bearing = (image.cam_from_world * track.point_in_world).normalized()});
    }
    subproblem.scene.tracks.push_back(track);
  }
  std::map<ImageId, std::vector<PatchSupport>> of_image;
  AddSupport(SupportOf(subproblem), of_image);
  const SupportVerdict verdict = JudgeSupport(of_image.at(ImageId(1)));
  EXPECT_TRUE(verdict.is_weak);
  EXPECT_THAT(verdict.reason, HasSubstr("do not fix its pose"));
}

TEST(SupportOf, WithoutAnImageIsAsIfItHadSeenNothing) {
  const Corridor corridor = Street();
  const ImageId gone(kImage.value + 1);
  Subproblem subproblem{.scene = TrueModel(corridor)};
  const std::vector<PatchSupport> without = SupportOf(subproblem, {gone});
  for (Track& track : subproblem.scene.tracks)
    std::erase_if(track.observations, [&](const Observation& s) { return s.ref.image == gone; });
  const std::vector<PatchSupport> expected = SupportOf(subproblem);
  ASSERT_EQ(without.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(without[i].image, expected[i].image);
    EXPECT_EQ(without[i].observations, expected[i].observations);
    EXPECT_EQ(without[i].hessian, expected[i].hessian);
  }
}

TEST(AdjustGlobally, WhatTwoSeeAloneIsNoSupportOnceTheThirdGoes) {
  const Corridor corridor = Street();
  Reconstruction three = TrueModel(corridor);
  std::erase_if(three.images, [](const auto& image) { return image.first.value > 2; });
  for (Track& track : three.tracks)
    std::erase_if(track.observations, [](const Observation& s) { return s.ref.image.value > 2; });
  std::erase_if(three.tracks, [](const Track& track) { return track.observations.size() < 2; });
  const auto whole = AdjustGlobally(three, corridor.manifest, {}, {}, {});
  ASSERT_TRUE(whole.ok()) << whole.status();
  EXPECT_THAT(whole->report.weak_images, IsEmpty());
  const auto keep_one_patch_of_the_third = [](std::vector<PatchSupport>& supports) {
    bool is_first = true;
    std::erase_if(supports, [&](const PatchSupport& patch) {
      return patch.image == ImageId(2) && !std::exchange(is_first, false);
    });
  };
  const auto none =
      AdjustGlobally(three, corridor.manifest, {}, {}, {}, keep_one_patch_of_the_third);
  ASSERT_TRUE(none.ok()) << none.status();
  EXPECT_THAT(none->report.weak_images, SizeIs(3));
  EXPECT_TRUE(none->reconstruction.images.empty());
}

TEST(SupportOf, DoesNotChangeWhenThePanoramaTurns) {
  const Corridor corridor = Street();
  const auto sum_of = [&](const Reconstruction& model) {
    Block6 sum = Block6::Zero();
    for (const PatchSupport& patch : SupportOf({.scene = model})) {
      if (patch.image == kImage) sum += patch.hessian;
    }
    return sum;
  };
  Reconstruction model = TrueModel(corridor);
  const Block6 before = sum_of(model);
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.2, -0.5, 0.7).normalized()));
  Rigid3& pose = model.images.at(kImage).cam_from_world;
  pose = Rigid3::FromCentre(turn * pose.rotation, pose.Centre());
  ForEachObservation(
      model, kImage, [&](Track&, Observation& seen) { seen.bearing = turn * seen.bearing; });
  EXPECT_LT((sum_of(model) - before).norm(), 1e-9 * before.norm());
}

TEST(SupportOf, PartsOfASubproblemAddUpToTheWhole) {
  const Corridor corridor = Street();
  Subproblem whole{.scene = TrueModel(corridor)};
  Subproblem first = whole;
  Subproblem second = whole;
  const auto half = static_cast<std::ptrdiff_t>(whole.scene.tracks.size() / 2);
  first.scene.tracks.erase(first.scene.tracks.begin() + half, first.scene.tracks.end());
  second.scene.tracks.erase(second.scene.tracks.begin(), second.scene.tracks.begin() + half);
  std::map<ImageId, std::vector<PatchSupport>> together;
  std::map<ImageId, std::vector<PatchSupport>> apart;
  AddSupport(SupportOf(whole), together);
  AddSupport(SupportOf(first), apart);
  AddSupport(SupportOf(second), apart);
  const SupportVerdict a = JudgeSupport(together.at(kImage));
  const SupportVerdict b = JudgeSupport(apart.at(kImage));
  EXPECT_NEAR(a.scatter, b.scatter, 1e-9 * a.scatter);
  EXPECT_NEAR(a.coherence, b.coherence, 1e-6 * a.coherence);
}

TEST(AdjustGlobally, AnImageWhoseBearingsScatterClaimsLess) {
  const Corridor corridor = Street();
  const ImageId scattered(1);  // next to the one that is held
  Reconstruction noisy = TrueModel(corridor);
  Random random(4);
  ForEachObservation(noisy, scattered, [&](Track&, Observation& seen) {
    const Eigen::Vector3d error(random.Normal(), random.Normal(), random.Normal());
    seen.bearing = (seen.bearing + 1.5e-3 * error).normalized();
  });
  const GloballyAdjusted clean = Adjust(TrueModel(corridor), corridor);
  const GloballyAdjusted adjusted = Adjust(noisy, corridor);
  const auto turn = [](const GloballyAdjusted& model, ImageId id) {
    return model.reconstruction.images.at(id).uncertainty->rotation_sigma_rad;
  };
  // Noise of 0.5 px, and of 1.3 px beside it.
  const double own = turn(adjusted, scattered) / turn(clean, scattered);
  const double neighbours = turn(adjusted, ImageId(2)) / turn(clean, ImageId(2));
  EXPECT_GT(own, 1.4);
  EXPECT_GT(own, 1.1 * neighbours);  // which see some of it through it
}

}  // namespace
}  // namespace orbweave
