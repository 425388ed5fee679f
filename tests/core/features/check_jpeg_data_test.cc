// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/check_jpeg_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/features/decode_panorama.h"
#include "tests/core/features/panorama_images.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view kEndOfImage = "\xFF\xD9";

std::string Jpeg(const cv::Mat& image, const std::vector<int>& parameters = {}) {
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", image, bytes, parameters);
  return {bytes.begin(), bytes.end()};
}

/// Baseline, progressive, with restart markers, and grey.
std::vector<std::string> IntactJpegs() {
  const cv::Mat panorama = TexturedPanorama(256, 1);
  cv::Mat grey;
  cv::extractChannel(panorama, grey, 0);
  return {Jpeg(panorama),
          Jpeg(panorama, {cv::IMWRITE_JPEG_PROGRESSIVE, 1}),
          Jpeg(panorama, {cv::IMWRITE_JPEG_RST_INTERVAL, 4}),
          Jpeg(grey)};
}

std::string ProblemOf(std::string_view encoded) {
  return std::string(CheckJpegData(encoded).message());
}

TEST(CheckJpegData, PassesWhatIsIntact) {
  for (const std::string& jpeg : IntactJpegs()) EXPECT_EQ(ProblemOf(jpeg), "");
}

TEST(CheckJpegData, PassesWhatCamerasAdd) {
  const std::string jpeg = IntactJpegs()[0];
  EXPECT_EQ(ProblemOf(jpeg + "maker's notes"), "");
  std::string filled = jpeg;
  filled.insert(filled.size() - 2, 10, '\0');
  EXPECT_EQ(ProblemOf(filled), "");
}

TEST(CheckJpegData, SeesAPictureThatWasCutWhereverItWasCut) {
  for (const std::string& jpeg : IntactJpegs()) {
    for (const double share : {0.3, 0.5, 0.8, 0.95}) {
      const auto length = static_cast<size_t>(share * static_cast<double>(jpeg.size()));
      const std::string cut = jpeg.substr(0, length) + std::string(kEndOfImage);
      EXPECT_THAT(ProblemOf(cut), HasSubstr("the data are damaged (")) << share;
      const auto decoded = DecodePanorama(cut, 4096);
      EXPECT_THAT(std::string(decoded.status().message()), HasSubstr("damaged")) << share;
    }
  }
}

TEST(CheckJpegData, SeesAHoleInTheData) {
  for (const std::string& jpeg : IntactJpegs()) {
    std::string holed = jpeg;
    holed.replace(holed.size() / 2, holed.size() / 8, holed.size() / 8, '\x55');
    EXPECT_NE(ProblemOf(holed), "");
  }
}

TEST(CheckJpegData, SeesMoreThanAFewBytesThatBelongToNothing) {
  std::string jpeg = IntactJpegs()[0];
  jpeg.insert(jpeg.size() - 2, jpeg.size() / 10, 'x');
  EXPECT_THAT(ProblemOf(jpeg), HasSubstr("extraneous"));
}

TEST(CheckJpegData, RefusesWhatIsNoJpeg) {
  EXPECT_NE(ProblemOf("no picture"), "");
  EXPECT_NE(ProblemOf(""), "");
  EXPECT_NE(ProblemOf(kEndOfImage), "");
}

}  // namespace
}  // namespace orbweave
