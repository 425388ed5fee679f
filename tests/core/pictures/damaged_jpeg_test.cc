// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pictures/decode_picture.h"
#include "tests/core/pictures/encoded_images.h"
#include "tests/core/pictures/noisy_image.h"

namespace orbweave {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr std::string_view kEndOfImage = "\xFF\xD9";

/// Baseline, progressive, with restart markers, and grey.
std::vector<std::string> IntactJpegs() {
  const cv::Mat image = NoisyImage();
  cv::Mat grey;
  cv::extractChannel(image, grey, 0);
  return {Encoded(image, ".jpg"),
          Encoded(image, ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1}),
          Encoded(image, ".jpg", {cv::IMWRITE_JPEG_RST_INTERVAL, 4}),
          Encoded(grey, ".jpg")};
}

std::string ProblemOf(std::string_view encoded) {
  return std::string(DecodePicture(encoded).status().message());
}

TEST(DamagedJpeg, PassesWhatIsIntact) {
  for (const std::string& jpeg : IntactJpegs()) EXPECT_EQ(ProblemOf(jpeg), "");
}

TEST(DamagedJpeg, PassesWhatCamerasAdd) {
  const std::string jpeg = IntactJpegs()[0];
  EXPECT_EQ(ProblemOf(jpeg + "maker's notes"), "");
  std::string filled = jpeg;
  filled.insert(filled.size() - 2, 10, '\0');
  EXPECT_EQ(ProblemOf(filled), "");
}

TEST(DamagedJpeg, SeesAPictureThatWasCutWhereverItWasCut) {
  for (const std::string& jpeg : IntactJpegs()) {
    for (const double share : {0.3, 0.5, 0.8, 0.95}) {
      const auto length = static_cast<size_t>(share * static_cast<double>(jpeg.size()));
      const std::string cut = jpeg.substr(0, length) + std::string(kEndOfImage);
      EXPECT_THAT(ProblemOf(cut),
                  AnyOf(HasSubstr("the data are damaged ("), HasSubstr("truncated")))
          << share;
    }
  }
}

TEST(DamagedJpeg, SeesAHoleInTheData) {
  for (const std::string& jpeg : IntactJpegs()) {
    std::string holed = jpeg;
    holed.replace(holed.size() / 2, holed.size() / 8, holed.size() / 8, '\x55');
    EXPECT_NE(ProblemOf(holed), "");
  }
}

TEST(DamagedJpeg, SeesMoreThanAFewBytesThatBelongToNothing) {
  std::string jpeg = IntactJpegs()[0];
  jpeg.insert(jpeg.size() - 2, jpeg.size() / 10, 'x');
  EXPECT_THAT(ProblemOf(jpeg), HasSubstr("extraneous"));
}

TEST(DamagedJpeg, RefusesWhatIsNoJpeg) {
  EXPECT_NE(ProblemOf("no picture"), "");
  EXPECT_NE(ProblemOf(""), "");
  EXPECT_NE(ProblemOf(kEndOfImage), "");
}

}  // namespace
}  // namespace orbweave
