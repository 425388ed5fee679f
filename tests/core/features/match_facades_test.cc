// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/match_facades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/base/random.h"
#include "core/features/extract_features.h"
#include "core/features/match_descriptors.h"
#include "core/geometry/facade_view.h"
#include "tests/core/features/panorama_images.h"

namespace orbweave {
namespace {

constexpr int kWidth = 512;
constexpr double kSame_rad = 0.005;

Features Extract(const cv::Mat& panorama, bool wants_facades, const std::string& mask = {}) {
  const std::string image = Encoded(panorama, ".png");
  const auto features = ExtractFeatures(
      {.encoded_image = image, .encoded_mask = mask, .wants_facades = wants_facades}, {}, {});
  EXPECT_TRUE(features.ok()) << features.status();
  return *features;
}

/// Grey of a wall, smooth on a scale of some centimetres.
class Wall {
 public:
  explicit Wall(uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < 6000; ++i) {
      blobs_.push_back({random.Uniform(-30.0, 30.0),
                        random.Uniform(-8.0, 8.0),
                        std::exp(random.Uniform(-2.6, -1.0)),
                        random.Uniform(-60.0, 60.0)});
    }
    std::ranges::sort(blobs_, {}, &Spot::x);
  }
  [[nodiscard]] double At(double x, double y) const {
    double grey = 120.0;
    auto spot = std::ranges::lower_bound(blobs_, x - 1.5, {}, &Spot::x);
    for (; spot != blobs_.end() && spot->x < x + 1.5; ++spot) {
      const double squared = std::pow(x - spot->x, 2) + std::pow(y - spot->y, 2);
      grey += spot->contrast * std::exp(-0.5 * squared / (spot->sigma * spot->sigma));
    }
    return std::clamp(grey, 0.0, 255.0);
  }

 private:
  struct Spot {
    double x = 0.0;
    double y = 0.0;
    double sigma = 0.1;
    double contrast = 0.0;
  };
  std::vector<Spot> blobs_;
};

/// A panorama from `x` metres along a wall that stands 6 m away, turned by some columns.
cv::Mat SeenFrom(const Wall& wall, double x, int columns) {
  const EquirectangularCamera camera{kWidth, kWidth / 2};
  cv::Mat panorama(kWidth / 2, kWidth, CV_8UC3, cv::Scalar(120, 120, 120));
  for (int row = 0; row < panorama.rows; ++row) {
    for (int column = 0; column < panorama.cols; ++column) {
      const Eigen::Vector3d ray = camera.BearingFromPixel({column + 0.5, row + 0.5});
      if (ray.z() < 0.15) continue;
      const Eigen::Vector3d at = ray * (6.0 / ray.z());
      const auto grey = static_cast<uint8_t>(wall.At(x + at.x(), at.y()));
      panorama.at<cv::Vec3b>(row, (column + columns) % kWidth) = {grey, grey, grey};
    }
  }
  return panorama;
}

/// Matches that show one spot of the wall, 8 m on.
size_t CountRight(const std::vector<FeatureMatch>& matches, const PairSide& a, const PairSide& b) {
  return static_cast<size_t>(std::ranges::count_if(matches, [&](const FeatureMatch& match) {
    const Eigen::Vector3d& p = a.bearings[match.a];
    const Eigen::Vector3d& q = b.bearings[match.b];
    if (p.z() < 0.1 || q.z() < 0.1) return false;
    const Eigen::Vector3d moved = q * (6.0 / q.z()) + Eigen::Vector3d(8.0, 0.0, 0.0);
    return (p * (6.0 / p.z()) - moved).norm() < 0.25;
  }));
}

std::vector<FeatureMatch> FacadeMatches(const PairSide& a, const PairSide& b, double same_rad) {
  std::vector<FeatureMatch> matches;
  for (const RatedMatch& rated : MatchFacades(a, b, same_rad, {})) {
    EXPECT_GE(rated.squared_ratio, 0.0);
    EXPECT_LT(rated.squared_ratio, 1.0);
    matches.push_back(rated.match);
  }
  return matches;
}

TEST(MatchFacades, FindsAWallAgainThatWasTiltedAway) {
  const Wall wall(1);
  const PairSide a(Extract(SeenFrom(wall, 0.0, 0), true));
  const PairSide b(Extract(SeenFrom(wall, 8.0, 0), true));
  const std::vector<FeatureMatch> facades = FacadeMatches(a, b, kSame_rad);
  const PairSide plain_a(Extract(SeenFrom(wall, 0.0, 0), false));
  const PairSide plain_b(Extract(SeenFrom(wall, 8.0, 0), false));
  const auto plain = MatchDescriptors(plain_a.features, plain_b.features, {});
  EXPECT_GE(CountRight(facades, a, b), 20U);
  EXPECT_GT(CountRight(facades, a, b), 2 * CountRight(plain, plain_a, plain_b));
  EXPECT_GT(2 * CountRight(facades, a, b), facades.size());
}

TEST(MatchFacades, FindsTheTurn) {
  const cv::Mat panorama = TexturedPanorama(kWidth, 2);
  const PairSide a(Extract(panorama, true));
  for (const int eighths : {0, 3, 6}) {
    const int columns = eighths * kWidth / kNumFacadeViews;
    const PairSide b(Extract(Rolled(panorama, columns), true));
    const std::vector<FeatureMatch> matches = FacadeMatches(a, b, kSame_rad);
    ASSERT_GT(matches.size(), 500U) << eighths;
    EXPECT_TRUE(std::ranges::is_sorted(matches));
    for (const FeatureMatch& match : matches) {
      const Keypoint& p = a.features.keypoints[match.a];
      const Keypoint& q = b.features.keypoints[match.b];
      EXPECT_NEAR(std::remainder(q.x_px - p.x_px - columns, kWidth), 0.0, 0.5);
      EXPECT_NEAR(q.y_px, p.y_px, 0.5);
    }
  }
}

TEST(MatchFacades, ArePlacesOnce) {
  const PairSide side(Extract(TexturedPanorama(kWidth, 3), true));
  const double far = 0.2;
  const auto matches = MatchFacades(side, side, far, {});
  const auto all = MatchFacades(side, side, 1e-9, {});
  EXPECT_LT(matches.size(), all.size() / 2);
  EXPECT_GT(matches.size(), 50U);
}

TEST(MatchFacades, AreNoneWithoutFacades) {
  const cv::Mat panorama = TexturedPanorama(kWidth, 4);
  const PairSide with(Extract(panorama, true));
  const PairSide without(Extract(panorama, false));
  EXPECT_FALSE(without.HasFacades());
  EXPECT_TRUE(MatchFacades(with, without, kSame_rad, {}).empty());
  EXPECT_TRUE(MatchFacades(without, with, kSame_rad, {}).empty());
}

TEST(AppendFacadeFeatures, LeavesThoseOfThePanoramaAsTheyAre) {
  const cv::Mat panorama = TexturedPanorama(kWidth, 5);
  const Features plain = Extract(panorama, false);
  const Features all = Extract(panorama, true);
  ASSERT_EQ(all.NumPlain(), plain.size());
  ASSERT_GT(all.size(), plain.size() + 500);
  EXPECT_TRUE(std::ranges::is_sorted(all.view));
  EXPECT_EQ(all.view.back(), kNumFacadeViews);
  EXPECT_TRUE(
      std::equal(plain.descriptors.begin(), plain.descriptors.end(), all.descriptors.begin()));
  EXPECT_EQ(all.sigma_rad.size(), all.size());
  EXPECT_EQ(all.colors.size(), all.size());
  EXPECT_EQ(all.descriptors.size(), all.size() * kDescriptorSize);
}

TEST(AppendFacadeFeatures, TurnAlongWithThePanorama) {
  const cv::Mat panorama = TexturedPanorama(kWidth, 6);
  const Features upright = Extract(panorama, true);
  const Features turned = Extract(Rolled(panorama, kWidth / kNumFacadeViews), true);
  const auto of_view = [](const Features& features, int view) {
    return std::ranges::count(features.view, static_cast<uint8_t>(view));
  };
  for (int view = 1; view <= kNumFacadeViews; ++view)
    EXPECT_EQ(of_view(upright, view), of_view(turned, view % kNumFacadeViews + 1)) << view;
}

TEST(AppendFacadeFeatures, AreNoneOfTinyPanoramas) {
  for (const int width : {2, 16, 64}) {
    const Features features =
        Extract(cv::Mat(width / 2, width, CV_8UC3, cv::Scalar(9, 9, 9)), true);
    EXPECT_TRUE(features.view.empty());
    EXPECT_EQ(features.problem, "");
  }
  EXPECT_GT(Extract(TexturedPanorama(128, 8), true).size(), 0U);
}

TEST(AppendFacadeFeatures, ReduceLargePanoramas) {
  cv::Mat large;
  cv::resize(TexturedPanorama(kWidth, 9), large, cv::Size(8192, 4096), 0, 0, cv::INTER_CUBIC);
  const Features features = Extract(large, true);
  ASSERT_GT(features.size(), features.NumPlain() + 300);
  for (size_t i = features.NumPlain(); i < features.size(); ++i) {
    EXPECT_LE(features.keypoints[i].x_px, 8192.0F);
    EXPECT_LE(features.keypoints[i].y_px, 4096.0F);
  }
  const auto widest = std::ranges::max_element(
      features.keypoints.begin() + static_cast<std::ptrdiff_t>(features.NumPlain()),
      features.keypoints.end(),
      {},
      &Keypoint::x_px);
  EXPECT_GT(widest->x_px, 7000.0F);
}

TEST(AppendFacadeFeatures, AreNotWhereAMaskIs) {
  const cv::Mat panorama = TexturedPanorama(kWidth, 7);
  cv::Mat mask(kWidth / 2, kWidth, CV_8UC1, cv::Scalar(0));
  mask.colRange(100, 300).setTo(255);
  const Features features = Extract(panorama, true, Encoded(mask, ".png"));
  for (const Keypoint& keypoint : features.keypoints)
    EXPECT_FALSE(keypoint.x_px > 101.0F && keypoint.x_px < 299.0F) << keypoint.x_px;
  EXPECT_GT(features.size(), 500U);
}

}  // namespace
}  // namespace orbweave
