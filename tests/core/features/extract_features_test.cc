// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/extract_features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/core/features/panorama_images.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 512;

ExtractOptions With(SiftDetector detector) {
  ExtractOptions options;
  options.detector = detector;
  return options;
}

Features Extract(const cv::Mat& panorama,
                 const ExtractOptions& options = {},
                 const std::string& mask = {}) {
  const std::string image = Encoded(panorama, ".png");
  const auto features =
      ExtractFeatures({.encoded_image = image, .encoded_mask = mask}, options, {});
  EXPECT_TRUE(features.ok()) << features.status();
  return *features;
}

/// Share of a's keypoints, moved by some columns, that b has too: same place, scale, direction.
double ShareFound(const Features& a, const Features& b, int columns) {
  size_t found = 0;
  for (const Keypoint& p : a.keypoints) {
    const double x = std::fmod(p.x_px + columns, a.camera.width_px);
    found += std::any_of(b.keypoints.begin(), b.keypoints.end(), [&](const Keypoint& q) {
      const double dx = std::remainder(q.x_px - x, a.camera.width_px);
      const double turn =
          std::remainder(q.orientation_rad - p.orientation_rad, 2.0 * std::numbers::pi);
      return std::hypot(dx, q.y_px - p.y_px) < 0.05 * p.scale_px &&
             std::abs(q.scale_px / p.scale_px - 1.0) < 0.05 && std::abs(turn) < 0.05;
    });
  }
  return static_cast<double>(found) / static_cast<double>(a.size());
}

bool Equal(const Features& a, const Features& b) {
  const auto same = [](const Keypoint& p, const Keypoint& q) {
    return p.x_px == q.x_px && p.y_px == q.y_px && p.scale_px == q.scale_px &&
           p.orientation_rad == q.orientation_rad;
  };
  return std::equal(a.keypoints.begin(),
                    a.keypoints.end(),
                    b.keypoints.begin(),
                    b.keypoints.end(),
                    same) &&
         a.descriptors == b.descriptors && a.colors == b.colors && a.sigma_rad == b.sigma_rad;
}

class EveryDetector : public ::testing::TestWithParam<SiftDetector> {};

INSTANTIATE_TEST_SUITE_P(ExtractFeatures,
                         EveryDetector,
                         ::testing::Values(SiftDetector::kStreaming, SiftDetector::kOpencv));

TEST_P(EveryDetector, IsEquivariantToTurningThePanorama) {
  const ExtractOptions options = With(GetParam());
  const cv::Mat panorama = TexturedPanorama(kWidth, 1);
  const Features upright = Extract(panorama, options);
  ASSERT_GT(upright.size(), 500U);
  Random random(2);
  for (int trial = 0; trial < 3; ++trial) {
    const int columns =
        16 * static_cast<int>(random.Index(kWidth / 16));  // on the grid of all octaves
    EXPECT_GT(ShareFound(upright, Extract(Rolled(panorama, columns), options), columns), 0.99)
        << columns;
  }
  const int odd_columns =
      1 + 2 * static_cast<int>(random.Index(kWidth / 2));  // coarse octaves resampled
  EXPECT_GT(ShareFound(upright, Extract(Rolled(panorama, odd_columns), options), odd_columns), 0.85)
      << odd_columns;
}

TEST_P(EveryDetector, FindsAsManyFeaturesAtTheSeamAsElsewhere) {
  const ExtractOptions options = With(GetParam());
  const cv::Mat panorama = TexturedPanorama(kWidth, 3);
  const auto near_column = [](const Features& features, double column) {
    return std::count_if(
        features.keypoints.begin(), features.keypoints.end(), [&](const Keypoint& p) {
          return std::abs(std::remainder(p.x_px - column, kWidth)) < 8.0;
        });
  };
  const auto at_seam = near_column(Extract(Rolled(panorama, kWidth / 2), options), 0.0);
  EXPECT_GT(at_seam, 10);
  EXPECT_EQ(at_seam, near_column(Extract(panorama, options), kWidth / 2.0));
}

TEST(ExtractFeatures, DoesNotDependOnTheTiles) {
  const cv::Mat panorama = TexturedPanorama(kWidth, 4);
  ExtractOptions small_tiles = With(SiftDetector::kOpencv);
  small_tiles.tile_size_px = 128;
  const Features whole = Extract(panorama, With(SiftDetector::kOpencv));
  const Features tiled = Extract(panorama, small_tiles);
  EXPECT_NEAR(static_cast<double>(whole.size()),
              static_cast<double>(tiled.size()),
              0.002 * static_cast<double>(whole.size()));
  EXPECT_GT(ShareFound(whole, tiled, 0), 0.995);
  EXPECT_GT(ShareFound(tiled, whole, 0), 0.995);
}

TEST_P(EveryDetector, DoesNotDependOnTheNumberOfThreads) {
  const std::string image = Encoded(TexturedPanorama(kWidth, 5), ".png");
  ExtractOptions options = With(GetParam());
  options.tile_size_px = 128;
  const auto one = ExtractFeatures({.encoded_image = image}, options, {.num_threads = 1});
  const auto three = ExtractFeatures({.encoded_image = image}, options, {.num_threads = 3});
  cv::setNumThreads(2);
  const auto opencv_two = ExtractFeatures({.encoded_image = image}, options, {.num_threads = 1});
  cv::setNumThreads(-1);
  EXPECT_TRUE(Equal(*one, *three));
  EXPECT_TRUE(Equal(*one, *opencv_two));
}

TEST_P(EveryDetector, LocatesBlobsWithoutBias) {
  Random random(6);
  std::vector<Blob> blobs;
  for (int y = 80; y < 180; y += 24) {
    for (int x = 0; x < kWidth - 12; x += 32) {
      blobs.push_back({.x_px = x + random.Uniform(),
                       .y_px = y + random.Uniform(),
                       .sigma_px = random.Uniform(1.5, 3.0)});
    }
  }
  ExtractOptions blobs_only = With(GetParam());
  blobs_only.contrast_threshold = 0.03;  // not the steps of 8 bits around them
  const Features features = Extract(DrawBlobs(kWidth, blobs), blobs_only);
  double found = 0.0;
  double sum_x = 0.0;
  double sum_y = 0.0;
  for (const Blob& blob : blobs) {
    double nearest_px = 1e9;
    cv::Point2d offset;
    for (const Keypoint& p : features.keypoints) {
      const cv::Point2d d(std::remainder(p.x_px - blob.x_px, kWidth), p.y_px - blob.y_px);
      if (cv::norm(d) < nearest_px) offset = d;
      nearest_px = std::min(nearest_px, cv::norm(d));
    }
    if (nearest_px > 5.0)
      continue;  // midway between two sampled scales a perfect blob is no extremum
    EXPECT_LT(nearest_px, 0.1);
    found += 1.0;
    sum_x += offset.x;
    sum_y += offset.y;
  }
  EXPECT_GT(found, 0.9 * static_cast<double>(blobs.size()));
  EXPECT_NEAR(sum_x / found, 0.0, 0.01);
  EXPECT_NEAR(sum_y / found, 0.0, 0.01);
}

TEST_P(EveryDetector, MeasuresBlobsScales) {
  for (const double sigma_px : {2.0, 5.0, 14.0}) {
    const Features features =
        Extract(DrawBlobs(kWidth, {{.x_px = 256.3, .y_px = 128.2, .sigma_px = sigma_px}}),
                With(GetParam()));
    ASSERT_FALSE(features.keypoints.empty()) << sigma_px;
    const auto nearest = std::min_element(
        features.keypoints.begin(), features.keypoints.end(), [](const auto& p, const auto& q) {
          return std::hypot(p.x_px - 256.3, p.y_px - 128.2) <
                 std::hypot(q.x_px - 256.3, q.y_px - 128.2);
        });
    EXPECT_NEAR(nearest->scale_px, sigma_px, 0.25 * sigma_px);
    EXPECT_NEAR(nearest->x_px, 256.3, 0.05 * sigma_px);
    EXPECT_NEAR(nearest->y_px, 128.2, 0.05 * sigma_px);
  }
}

/// Mean difference of keypoints that are nearest to each other, of the same scale and direction.
struct MeanDifference {
  size_t count = 0;
  double x_px = 0.0;
  double y_px = 0.0;
  double log_scale = 0.0;
  double turn_rad = 0.0;
};

MeanDifference Compare(const Features& a, const Features& b) {
  MeanDifference mean;
  for (const Keypoint& p : a.keypoints) {
    for (const Keypoint& q : b.keypoints) {
      const double dx = std::remainder(q.x_px - p.x_px, a.camera.width_px);
      const double dy = q.y_px - p.y_px;
      const double log_scale = std::log(q.scale_px / p.scale_px);
      const double turn =
          std::remainder(q.orientation_rad - p.orientation_rad, 2.0 * std::numbers::pi);
      if (std::hypot(dx, dy) > 0.3 * p.scale_px || std::abs(log_scale) > 0.1 ||
          std::abs(turn) > 0.2)
        continue;
      ++mean.count;
      mean.x_px += dx;
      mean.y_px += dy;
      mean.log_scale += log_scale;
      mean.turn_rad += turn;
    }
  }
  const auto n = static_cast<double>(mean.count);
  return {mean.count, mean.x_px / n, mean.y_px / n, mean.log_scale / n, mean.turn_rad / n};
}

TEST(ExtractFeatures, AgreesWithOpencvWithoutBias) {
  const cv::Mat panorama = TexturedPanorama(2 * kWidth, 17);
  const Features expected = Extract(panorama, With(SiftDetector::kOpencv));
  const Features features = Extract(panorama);
  EXPECT_NEAR(static_cast<double>(features.size()),
              static_cast<double>(expected.size()),
              0.05 * static_cast<double>(expected.size()));
  const MeanDifference mean = Compare(expected, features);
  EXPECT_GT(static_cast<double>(mean.count), 0.8 * static_cast<double>(expected.size()));
  EXPECT_NEAR(mean.x_px, 0.0, 0.02);
  EXPECT_NEAR(mean.y_px, 0.0, 0.02);
  EXPECT_NEAR(mean.log_scale, 0.0, 0.01);
  EXPECT_NEAR(mean.turn_rad, 0.0, 0.01);
}

TEST(ExtractFeatures, DoublesNarrowPanoramasUnlessTold) {
  const cv::Mat panorama = TexturedPanorama(kWidth, 18);
  ExtractOptions doubled;
  doubled.first_octave = FirstOctave::kDoubled;
  ExtractOptions full;
  full.first_octave = FirstOctave::kFull;
  const Features automatic = Extract(panorama);
  EXPECT_TRUE(Equal(automatic, Extract(panorama, doubled)));
  const Features of_full = Extract(panorama, full);
  ASSERT_GT(of_full.size(), 100U);
  EXPECT_LT(of_full.size(), automatic.size());
  for (const Keypoint& p : of_full.keypoints) EXPECT_GT(p.scale_px, 1.26F);
  const cv::Mat wide = TexturedPanorama(6016, 19);
  EXPECT_TRUE(Equal(Extract(wide), Extract(wide, full)));
}

TEST(ExtractFeatures, FillsEveryFieldForEveryFeature) {
  const Features features = Extract(TexturedPanorama(kWidth, 7));
  EXPECT_EQ(features.camera, (EquirectangularCamera{.width_px = kWidth, .height_px = kWidth / 2}));
  EXPECT_EQ(features.sigma_rad.size(), features.size());
  EXPECT_EQ(features.colors.size(), features.size());
  ASSERT_EQ(features.descriptors.size(), features.size() * kDescriptorSize);
  EXPECT_TRUE(features.problem.empty());
  for (FeatureIndex i = 0; i < features.size(); ++i) {
    EXPECT_GE(features.keypoints[i].x_px, 0.0F);
    EXPECT_LT(features.keypoints[i].x_px, static_cast<float>(kWidth));
    EXPECT_GE(features.sigma_rad[i],
              static_cast<float>(features.camera.AngleFromPixels(1.0)) * 0.999F);
    double squares = 0.0;
    for (int k = 0; k < kDescriptorSize; ++k) squares += std::pow(features.Descriptor(i)[k], 2);
    EXPECT_NEAR(std::sqrt(squares), 512.0, 6.0);
  }
}

TEST(ExtractFeatures, SamplesColours) {
  cv::Mat panorama = DrawBlobs(kWidth, {{.x_px = 100.0, .y_px = 128.0, .sigma_px = 3.0}});
  cv::Mat channels[3];
  cv::split(panorama, channels);
  channels[0].setTo(10);  // blue
  cv::merge(channels, 3, panorama);
  const Features features = Extract(panorama);
  ASSERT_FALSE(features.colors.empty());
  EXPECT_EQ(features.colors[0].b, 10);
  EXPECT_GT(features.colors[0].r, 170);
  EXPECT_EQ(features.colors[0].r, features.colors[0].g);
}

TEST(ExtractFeatures, KeepsTheLatitudeLimit) {
  ExtractOptions options;
  options.max_latitude_deg = 30.0;
  const Features features = Extract(TexturedPanorama(kWidth, 8), options);
  ASSERT_GT(features.size(), 100U);
  for (const Keypoint& p : features.keypoints) {
    EXPECT_LE(std::abs(p.y_px / features.camera.height_px - 0.5) * 180.0, 30.0 + 1e-3);
  }
}

TEST(ExtractFeatures, KeepsTheLimitOfFeaturesAndSpreadsThem) {
  ExtractOptions options;
  options.max_features = 200;
  const Features features = Extract(TexturedPanorama(kWidth, 9), options);
  EXPECT_EQ(features.size(), 200U);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const auto in_quarter =
        std::count_if(features.keypoints.begin(), features.keypoints.end(), [&](const Keypoint& p) {
          return static_cast<int>(4.0F * p.x_px / kWidth) == quarter;
        });
    EXPECT_NEAR(static_cast<double>(in_quarter), 50.0, 15.0);
  }
}

TEST(ExtractFeatures, FindsNothingUnderTheMaskNorOnItsBorder) {
  const cv::Mat panorama = TexturedPanorama(kWidth, 10);
  cv::Mat ignored(kWidth / 2, kWidth, CV_8UC1, cv::Scalar(0));
  cv::rectangle(ignored, cv::Rect(200, 100, 120, 60), cv::Scalar(255), cv::FILLED);
  const Features free = Extract(panorama);
  const Features masked = Extract(panorama, {}, Encoded(ignored, ".png"));
  EXPECT_LT(masked.size(), free.size());
  EXPECT_GT(masked.size(), free.size() / 2);
  for (const Keypoint& p : masked.keypoints) {
    EXPECT_FALSE(p.x_px > 199.0F && p.x_px < 321.0F && p.y_px > 99.0F && p.y_px < 161.0F);
  }
}

TEST(ExtractFeatures, ReadsMasksInBothConventions) {
  const std::string image = Encoded(TexturedPanorama(kWidth, 11), ".png");
  cv::Mat white_left(kWidth / 2, kWidth, CV_8UC1, cv::Scalar(0));
  white_left(cv::Rect(0, 0, kWidth / 2, kWidth / 2)).setTo(255);
  const std::string white = Encoded(white_left, ".png");
  const std::string black = Encoded(255 - white_left, ".png");
  const auto a = ExtractFeatures(
      {.encoded_image = image, .encoded_mask = white, .mask_ignores_white = true}, {}, {});
  const auto b = ExtractFeatures(
      {.encoded_image = image, .encoded_mask = black, .mask_ignores_white = false}, {}, {});
  ASSERT_GT(a->size(), 0U);
  EXPECT_TRUE(Equal(*a, *b));
  for (const Keypoint& p : a->keypoints) EXPECT_GE(p.x_px, kWidth / 2.0F);
}

TEST(ExtractFeatures, AcceptsGreySixteenBitAndAlpha) {
  const cv::Mat bgr = TexturedPanorama(kWidth, 12);
  const Features expected = Extract(bgr);
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::Mat deep;
  bgr.convertTo(deep, CV_16UC3, 257.0);
  cv::Mat alpha;
  cv::cvtColor(bgr, alpha, cv::COLOR_BGR2BGRA);
  for (const cv::Mat& variant : {grey, deep, alpha}) {
    EXPECT_EQ(Extract(variant).size(), expected.size()) << "channels " << variant.channels();
  }
}

TEST(ExtractFeatures, ReturnsNoFeaturesOfABlankPanorama) {
  const Features features = Extract(cv::Mat(128, 256, CV_8UC3, cv::Scalar(90, 90, 90)));
  EXPECT_EQ(features.size(), 0U);
  EXPECT_TRUE(features.problem.empty());
}

TEST(ExtractFeatures, SurvivesTheSmallestPanorama) {
  EXPECT_TRUE(Extract(cv::Mat(1, 2, CV_8UC3, cv::Scalar(90, 90, 90))).problem.empty());
}

TEST(ExtractFeatures, NamesTheImageWithTheProblem) {
  const auto features =
      ExtractFeatures({.name = "a/b.jpg", .encoded_image = "not an image"}, {}, {});
  ASSERT_TRUE(features.ok());
  EXPECT_THAT(features->problem, HasSubstr("a/b.jpg: cannot decode"));
  EXPECT_EQ(features->size(), 0U);
}

TEST(ExtractFeatures, RefusesAMaskOfOtherProportions) {
  const std::string mask = Encoded(cv::Mat(128, 128, CV_8UC1, cv::Scalar(0)), ".png");
  const Features features = Extract(TexturedPanorama(256, 13), {}, mask);
  EXPECT_THAT(features.problem, HasSubstr("the mask is 128x128"));
  EXPECT_EQ(features.size(), 0U);
}

TEST(ExtractFeatures, ScalesAMaskOfAnotherResolution) {
  const cv::Mat panorama = TexturedPanorama(kWidth, 16);
  cv::Mat ignored(kWidth, 2 * kWidth, CV_8UC1, cv::Scalar(0));
  ignored(cv::Rect(400, 200, 240, 120)).setTo(255);
  cv::Mat small;
  cv::resize(ignored, small, panorama.size(), 0, 0, cv::INTER_NEAREST);
  EXPECT_TRUE(Equal(Extract(panorama, {}, Encoded(ignored, ".png")),
                    Extract(panorama, {}, Encoded(small, ".png"))));
}

TEST(ExtractFeatures, StopsOnRequest) {
  std::stop_source source;
  source.request_stop();
  const std::string image = Encoded(TexturedPanorama(256, 14), ".png");
  const auto features = ExtractFeatures({.encoded_image = image}, {}, {.stop = source.get_token()});
  EXPECT_EQ(features.status().code(), absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
