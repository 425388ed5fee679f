// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/decode_panorama.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pictures/image_header.h"
#include "tests/core/features/panorama_images.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

std::string ProblemOf(std::string_view encoded) {
  const auto decoded = DecodePanorama(encoded, 4096);
  return decoded.ok() ? "none" : std::string(decoded.status().message());
}

class EveryFormat : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formats,
                         EveryFormat,
                         ::testing::Values(".jpg", ".png", ".tiff", ".bmp", ".webp", ".ppm"));

TEST_P(EveryFormat, HeaderTellsTheSize) {
  const auto header = ReadImageHeader(Encoded(TexturedPanorama(256, 1), GetParam()));
  ASSERT_TRUE(header.ok()) << header.status();
  EXPECT_EQ(header->width_px, 256);
  EXPECT_EQ(header->height_px, 128);
  EXPECT_TRUE(header->complete);
}

TEST_P(EveryFormat, IsDecoded) {
  const auto decoded = DecodePanorama(Encoded(TexturedPanorama(256, 1), GetParam()), 4096);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(decoded->size(), cv::Size(256, 128));
  EXPECT_EQ(decoded->type(), CV_8UC3);
}

TEST_P(EveryFormat, IsRefusedWhenTruncated) {
  const std::string whole = Encoded(TexturedPanorama(256, 1), GetParam());
  for (const double share : {0.001, 0.1, 0.5, 0.9, 0.999}) {
    const auto length = static_cast<size_t>(share * static_cast<double>(whole.size() - 1));
    EXPECT_THAT(ProblemOf(whole.substr(0, length)), HasSubstr("cannot decode")) << share;
  }
}

TEST(DecodePanorama, RefusesATextFile) {
  EXPECT_THAT(ProblemOf("These are my holiday photographs."), HasSubstr("neither JPEG"));
  EXPECT_THAT(ProblemOf(""), HasSubstr("empty"));
}

TEST(DecodePanorama, RefusesWhatIsNotTwoToOne) {
  EXPECT_THAT(ProblemOf(Encoded(cv::Mat(100, 150, CV_8UC3, cv::Scalar(0)), ".jpg")),
              HasSubstr("not 2:1: 150x100"));
}

TEST(DecodePanorama, AllowsOnePixelBeyondTwoToOne) {
  EXPECT_EQ(ProblemOf(Encoded(cv::Mat(100, 201, CV_8UC3, cv::Scalar(0)), ".png")), "none");
  EXPECT_THAT(ProblemOf(Encoded(cv::Mat(100, 202, CV_8UC3, cv::Scalar(0)), ".png")),
              HasSubstr("not 2:1"));
}

TEST(DecodePanorama, RefusesAWideImageByItsHeaderAlone) {
  std::string png = Encoded(cv::Mat(100, 200, CV_8UC3, cv::Scalar(0)), ".png");
  png.replace(16, 8, std::string("\0\1\0\0\0\0\x80\0", 8));  // 65536 x 32768: 6 GB of pixels
  EXPECT_THAT(ProblemOf(png), HasSubstr("too large: 65536x32768"));
}

TEST(DecodePanorama, RefusesAJpegBombByItsHeaderAlone) {
  std::string jpeg = Encoded(cv::Mat(100, 200, CV_8UC3, cv::Scalar(0)), ".jpg");
  const size_t frame = jpeg.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  jpeg.replace(frame + 5, 4, std::string("\x7F\xFE\xFF\xFC", 4));  // 65532 x 32766: 6 GB of pixels
  EXPECT_THAT(ProblemOf(jpeg), HasSubstr("too large: 65532x32766"));
}

TEST(DecodeMask, RefusesABombByItsHeaderAlone) {
  std::string png = Encoded(cv::Mat(100, 200, CV_8UC1, cv::Scalar(0)), ".png");
  png.replace(16, 8, std::string("\0\1\0\0\0\0\x80\0", 8));  // 65536 x 32768
  EXPECT_THAT(std::string(DecodeMask(png, {8, 4}, 4096, true).status().message()),
              HasSubstr("the mask is: too large: 65536x32768"));
}

TEST(ReadImageHeader, TakesTheLargerOfTwoWidthsInATiff) {
  std::string tiff = Encoded(TexturedPanorama(256, 1), ".tiff");
  const auto byte = [&tiff](size_t i) { return static_cast<uint8_t>(tiff[i]); };
  const size_t directory = byte(4) | byte(5) << 8 | byte(6) << 16 | byte(7) << 24;
  const size_t width = directory + 2;
  ASSERT_EQ(byte(width) | byte(width + 1) << 8, 256) << "the first tag is the width";
  const size_t third = width + 24;  // whatever it says, now it says the width again
  tiff.replace(third, 12, tiff.substr(width, 8) + std::string("\xFF\xFF\0\0", 4));
  EXPECT_EQ(ReadImageHeader(tiff)->width_px, 65535);
}

TEST(ReadImageHeader, ReadsCommentsAndWideSamplesOfPnm) {
  const std::string grey = "P5\n# made by hand\n 8\t4 # and this\n65535\n" + std::string(64, 'x');
  const auto header = ReadImageHeader(grey);
  ASSERT_TRUE(header.ok()) << header.status();
  EXPECT_EQ(header->width_px, 8);
  EXPECT_EQ(header->height_px, 4);
  EXPECT_TRUE(header->complete);
  EXPECT_FALSE(ReadImageHeader(grey.substr(0, grey.size() - 1))->complete);
  EXPECT_TRUE(DecodePanorama(grey, 4096).ok());
}

TEST(ReadImageHeader, KnowsThatPixelsOfABmpAreMissingWhateverTheFileSaysOfItsLength) {
  std::string bmp = Encoded(TexturedPanorama(256, 1), ".bmp");
  bmp.replace(2, 4, std::string(4, '\0'));  // as some programs leave it
  EXPECT_TRUE(ReadImageHeader(bmp)->complete);
  EXPECT_FALSE(ReadImageHeader(bmp.substr(0, bmp.size() / 2))->complete);
}

TEST(DecodePanorama, IgnoresThumbnailsWhenLookingForTheEnd) {
  const std::string jpeg = Encoded(TexturedPanorama(256, 1), ".jpg");
  const std::string thumbnail = Encoded(TexturedPanorama(64, 1), ".jpg");
  std::string app1 = "\xFF\xE1";
  app1 += static_cast<char>((thumbnail.size() + 2) >> 8);
  app1 += static_cast<char>((thumbnail.size() + 2) & 0xFF);
  const std::string with_thumbnail = jpeg.substr(0, 2) + app1 + thumbnail + jpeg.substr(2);
  EXPECT_EQ(ProblemOf(with_thumbnail), "none");
  EXPECT_EQ(ReadImageHeader(with_thumbnail)->width_px, 256);
  EXPECT_THAT(ProblemOf(with_thumbnail.substr(0, with_thumbnail.size() - 500)),
              HasSubstr("truncated"));
}

TEST(DecodePanorama, AcceptsBytesBehindTheEndOfAJpeg) {
  EXPECT_EQ(ProblemOf(Encoded(TexturedPanorama(256, 1), ".jpg") + "maker's notes"), "none");
}

TEST(DecodeMask, MarksIgnoredPixels) {
  cv::Mat mask(4, 8, CV_8UC1, cv::Scalar(0));
  mask.at<uint8_t>(1, 2) = 255;
  const std::string encoded = Encoded(mask, ".png");
  EXPECT_EQ(cv::countNonZero(*DecodeMask(encoded, {8, 4}, 4096, true)), 1);
  EXPECT_EQ(cv::countNonZero(*DecodeMask(encoded, {8, 4}, 4096, false)), 31);
  EXPECT_EQ(DecodeMask(encoded, {8, 4}, 4096, true)->at<uint8_t>(1, 2), 255);
}

TEST(DecodeMask, RefusesAnUnreadableMask) {
  EXPECT_THAT(std::string(DecodeMask("x", {8, 4}, 4096, true).status().message()),
              HasSubstr("cannot decode the mask"));
}

}  // namespace
}  // namespace orbweave
