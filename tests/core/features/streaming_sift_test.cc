// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/streaming_sift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <vector>

#include "core/features/row_across_poles.h"
#include "tests/core/features/panorama_images.h"

namespace orbweave {
namespace {

constexpr double kWholeSphere_deg = 90.0;

/// A keypoint with all that is found of it.
struct Found {
  Keypoint keypoint{};
  float response = 0.0F;
  std::array<uint8_t, kDescriptorSize> descriptor{};
};

auto BitsOf(const Found& f) {
  return std::tie(f.keypoint.y_px,
                  f.keypoint.x_px,
                  f.keypoint.scale_px,
                  f.keypoint.orientation_rad,
                  f.response,
                  f.descriptor);
}

struct How {
  bool doubled = true;
  double max_latitude_deg = kWholeSphere_deg;
  SiftKernel kernel = AvailableSiftKernels().back();
};

/// All keypoints of a panorama within the latitudes, sorted.
std::vector<Found> FindAll(const cv::Mat& panorama, const How& how = {}) {
  const double rows = how.max_latitude_deg / 180.0 * panorama.rows;
  const double first_y = 0.5 * panorama.rows - rows;
  const double end_y = 0.5 * panorama.rows + rows;
  StreamingSift sift(panorama,
                     {.thresholds = {.contrast = 0.01},
                      .doubled = how.doubled,
                      .first_y = first_y,
                      .end_y = end_y,
                      .kernel = how.kernel});
  EXPECT_TRUE(sift.Detect({}).ok());
  std::vector<uint32_t> all;
  for (size_t i = 0; i < sift.num_positions(); ++i) {
    const double y = sift.KeypointOf(i).y_px;
    if (y >= first_y && y <= end_y) all.push_back(static_cast<uint32_t>(i));
  }
  const auto described = sift.Describe(all, {});
  std::vector<Found> found;
  for (const internal::DescribedPosition& d : *described) {
    Found& f = found.emplace_back();
    f.keypoint = sift.KeypointOf(d.position);
    f.keypoint.orientation_rad = d.orientation_rad;
    f.response = sift.ResponseOf(d.position);
    f.descriptor = d.descriptor;
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return BitsOf(a) < BitsOf(b);
  });
  return found;
}

/// What does not change, in bits, where a panorama is turned by whole pixels of all octaves.
auto TurnedBitsOf(const Found& f) {
  return std::tie(
      f.keypoint.y_px, f.keypoint.scale_px, f.response, f.keypoint.orientation_rad, f.descriptor);
}

/// Whether `turned` is `found` with its columns moved.
void ExpectTurned(std::vector<Found> found, std::vector<Found> turned, int columns, int width) {
  const auto by_bits = [](const Found& a, const Found& b) {
    return TurnedBitsOf(a) < TurnedBitsOf(b);
  };
  std::sort(found.begin(), found.end(), by_bits);
  std::sort(turned.begin(), turned.end(), by_bits);
  ASSERT_EQ(found.size(), turned.size()) << columns;
  for (size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(TurnedBitsOf(found[i]), TurnedBitsOf(turned[i])) << columns;
    const double dx = turned[i].keypoint.x_px - found[i].keypoint.x_px - columns;
    EXPECT_NEAR(std::remainder(dx, width), 0.0, 1e-3) << columns;
  }
}

/// Share of the keypoints of `a` that are among those of `b` moved by some columns.
double ShareAmong(const std::vector<Found>& a,
                  const std::vector<Found>& b,
                  int columns,
                  int width) {
  double among = 0.0;
  for (const Found& p : a) {
    among += std::any_of(b.begin(), b.end(), [&](const Found& q) {
      const double dx = std::remainder(q.keypoint.x_px - p.keypoint.x_px - columns, width);
      return std::hypot(dx, q.keypoint.y_px - p.keypoint.y_px) < 0.05 * p.keypoint.scale_px &&
             std::abs(q.keypoint.scale_px / p.keypoint.scale_px - 1.0F) < 0.05F;
    });
  }
  return among / static_cast<double>(a.size());
}

TEST(StreamingSift, TurnsWithThePanoramaToTheBit) {
  const cv::Mat panorama = TexturedPanorama(512, 1);
  for (const bool doubled : {false, true}) {
    const std::vector<Found> found = FindAll(panorama, {.doubled = doubled});
    ASSERT_GT(found.size(), 300U);
    for (const int columns : {8, 136, 256, 504})
      ExpectTurned(found, FindAll(Rolled(panorama, columns), {.doubled = doubled}), columns, 512);
  }
}

TEST(StreamingSift, TurnsWithThePanoramaWhereOctavesAreResampled) {
  const int width = 600;  // octave 2 would have 37.5 x 75 pixels
  const cv::Mat panorama = TexturedPanorama(width, 2);
  const std::vector<Found> found = FindAll(panorama);
  ASSERT_GT(found.size(), 300U);
  for (const int columns : {1, 37, 150, 299})
    EXPECT_GT(ShareAmong(found, FindAll(Rolled(panorama, columns)), columns, width), 0.9)
        << columns;
}

/// Response, scale, column and distance from the horizon of every position.
std::vector<std::tuple<float, float, float, float>> PlacesOf(const cv::Mat& panorama) {
  StreamingSift sift(
      panorama, {.thresholds = {.contrast = 0.01}, .doubled = true, .end_y = 1.0 * panorama.rows});
  EXPECT_TRUE(sift.Detect({}).ok());
  std::vector<std::tuple<float, float, float, float>> places;
  for (size_t i = 0; i < sift.num_positions(); ++i) {
    const Keypoint k = sift.KeypointOf(i);
    const float from_horizon = std::abs(k.y_px - 0.5F * static_cast<float>(panorama.rows));
    places.emplace_back(sift.ResponseOf(i), k.scale_px, k.x_px, std::round(100.0F * from_horizon));
  }
  std::sort(places.begin(), places.end());
  return places;
}

/// Every filter is symmetric and says so in bits.
TEST(StreamingSift, FindsTheSamePositionsUpsideDown) {
  const cv::Mat panorama = TexturedPanorama(512, 3);
  cv::Mat flipped;
  cv::flip(panorama, flipped, 0);
  const auto upright = PlacesOf(panorama);
  ASSERT_GT(upright.size(), 300U);
  EXPECT_EQ(upright, PlacesOf(flipped));
}

/// Rows that are left out would have changed nothing.
TEST(StreamingSift, FindsTheSameWithinLatitudesAsOnTheWholeSphere) {
  const cv::Mat panorama = TexturedPanorama(1024, 4);
  for (const bool doubled : {false, true}) {
    std::vector<Found> whole = FindAll(panorama, {.doubled = doubled});
    for (const double latitude_deg : {5.0, 20.0, 45.0, 80.0}) {
      const std::vector<Found> some =
          FindAll(panorama, {.doubled = doubled, .max_latitude_deg = latitude_deg});
      std::vector<Found> expected;
      for (const Found& f : whole) {
        if (std::abs(f.keypoint.y_px / 512.0 - 0.5) * 180.0 <= latitude_deg) expected.push_back(f);
      }
      ASSERT_GT(expected.size(), 50U);
      ASSERT_EQ(some.size(), expected.size()) << latitude_deg;
      for (size_t i = 0; i < some.size(); ++i)
        ASSERT_EQ(BitsOf(some[i]), BitsOf(expected[i])) << latitude_deg;
    }
  }
}

TEST(StreamingSift, FindsTheSameWithEveryKernel) {
  const cv::Mat panorama = TexturedPanorama(641, 5);
  const std::vector<Found> expected = FindAll(panorama, {.kernel = SiftKernel::kPortable});
  ASSERT_GT(expected.size(), 300U);
  for (const SiftKernel kernel : AvailableSiftKernels()) {
    const std::vector<Found> found = FindAll(panorama, {.kernel = kernel});
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) ASSERT_EQ(BitsOf(found[i]), BitsOf(expected[i]));
  }
}

/// Adds a blob as if the sphere were flat about its middle, across the seam and a pole.
void AddFoldedBlob(cv::Mat& grey, double x_px, double y_px, double sigma_px) {
  const int reach = static_cast<int>(5.0 * sigma_px) + 1;
  for (int y = static_cast<int>(y_px) - reach; y <= static_cast<int>(y_px) + reach; ++y) {
    for (int x = static_cast<int>(x_px) - reach; x <= static_cast<int>(x_px) + reach; ++x) {
      const double squares = std::pow(x + 0.5 - x_px, 2) + std::pow(y + 0.5 - y_px, 2);
      const SourceRow source = RowAcrossPoles(y, grey.rows);
      const int column = Modulo(x + (source.turned ? grey.cols / 2 : 0), grey.cols);
      grey.at<double>(source.row, column) +=
          80.0 * std::exp(-0.5 * squares / (sigma_px * sigma_px));
    }
  }
}

cv::Mat FromGreys(const cv::Mat& grey) {
  cv::Mat bytes;
  grey.convertTo(bytes, CV_8UC1);
  cv::Mat bgr;
  cv::cvtColor(bytes, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

TEST(StreamingSift, FindsBlobsAtSeamAndPolesAsAnywhere) {
  for (const double sigma_px : {2.2, 4.5, 8.0}) {
    for (const cv::Point2d& at : {cv::Point2d(100.3, 130.6),
                                  cv::Point2d(0.2, 120.4),
                                  cv::Point2d(511.9, 100.1),
                                  cv::Point2d(200.6, 1.3),
                                  cv::Point2d(0.4, 3.8),
                                  cv::Point2d(300.7, 254.9)}) {
      cv::Mat grey(256, 512, CV_64FC1, cv::Scalar(90.0));
      AddFoldedBlob(grey, at.x, at.y, sigma_px);
      bool is_found = false;
      for (const Found& f : FindAll(FromGreys(grey))) {
        is_found = is_found || (std::abs(std::remainder(f.keypoint.x_px - at.x, 512.0)) < 0.1 &&
                                std::abs(f.keypoint.y_px - at.y) < 0.1 &&
                                std::abs(f.keypoint.scale_px / sigma_px - 1.0) < 0.25);
      }
      EXPECT_TRUE(is_found) << sigma_px << " at " << at;
    }
  }
}

TEST(StreamingSift, WorksOnOddAndTinyPanoramas) {
  for (const cv::Size& size : {cv::Size(1001, 500),
                               cv::Size(999, 500),
                               cv::Size(641, 320),
                               cv::Size(64, 32),
                               cv::Size(65, 32)}) {
    cv::Mat grey(size, CV_64FC1, cv::Scalar(90.0));
    const cv::Point2d at(size.width - 0.8, 0.5 * size.height + 0.3);
    AddFoldedBlob(grey, at.x, at.y, 2.2);
    for (const bool doubled : {false, true}) {
      bool is_found = false;
      for (const Found& f : FindAll(FromGreys(grey), {.doubled = doubled})) {
        EXPECT_TRUE(f.keypoint.x_px >= 0.0F && f.keypoint.x_px < static_cast<float>(size.width));
        EXPECT_TRUE(f.keypoint.y_px >= 0.0F && f.keypoint.y_px <= static_cast<float>(size.height));
        is_found =
            is_found || (std::abs(std::remainder(f.keypoint.x_px - at.x, size.width)) < 0.1 &&
                         std::abs(f.keypoint.y_px - at.y) < 0.1);
      }
      EXPECT_TRUE(is_found) << size << " " << doubled;
    }
  }
  for (const cv::Size& size : {cv::Size(31, 16), cv::Size(2, 1)})  // not even one octave
    EXPECT_TRUE(FindAll(cv::Mat(size, CV_8UC3, cv::Scalar(9, 9, 9)), {.doubled = false}).empty());
}

TEST(StreamingSift, FindsNothingInAConstant) {
  for (const int grey : {0, 77, 255})
    EXPECT_TRUE(FindAll(cv::Mat(128, 256, CV_8UC3, cv::Scalar(grey, grey, grey))).empty());
}

TEST(StreamingSift, FindsEveryPositionOnce) {
  const std::vector<Found> found = FindAll(TexturedPanorama(512, 7));
  for (size_t i = 1; i < found.size(); ++i) EXPECT_LT(BitsOf(found[i - 1]), BitsOf(found[i]));
}

TEST(StreamingSift, StopsInTheMiddle) {
  const cv::Mat panorama = TexturedPanorama(512, 8);
  StreamingSift sift(panorama, {.doubled = true, .end_y = 256.0});
  std::stop_source stop;
  int calls = 0;
  const StageContext context{.stop = stop.get_token(), .alive = [&] {
                               if (++calls == 10) stop.request_stop();
                             }};
  EXPECT_EQ(sift.Detect(context).code(), absl::StatusCode::kCancelled);
  EXPECT_EQ(calls, 10);
}

}  // namespace
}  // namespace orbweave
