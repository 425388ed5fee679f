// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pictures/decode_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <opencv2/imgproc.hpp>

#include "tests/core/pictures/encoded_images.h"
#include "tests/core/pictures/noisy_image.h"
#include "tests/support/command.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

cv::Mat ByOracle(const std::string& encoded, int flags) {
  const std::vector<uint8_t> bytes(encoded.begin(), encoded.end());
  return cv::imdecode(bytes, flags | cv::IMREAD_IGNORE_ORIENTATION);
}

double LargestDifference(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() ? cv::norm(a, b, cv::NORM_INF) : 1e9;
}

std::string ProblemOf(std::string_view encoded) {
  return std::string(DecodePicture(encoded).status().message());
}

struct Form {
  std::string name;
  std::string extension;
  int type = CV_8UC3;
  std::vector<int> parameters{};
  double tolerance = 0.0;  ///< grey levels between two ways to make 8 bits of 16
};

std::ostream& operator<<(std::ostream& out, const Form& form) { return out << form.name; }

class EveryForm : public ::testing::TestWithParam<Form> {};
INSTANTIATE_TEST_SUITE_P(
    Forms,
    EveryForm,
    ::testing::Values(Form{"jpeg", ".jpg"},
                      Form{"jpeg_grey", ".jpg", CV_8UC1},
                      Form{"jpeg_progressive", ".jpg", CV_8UC3, {cv::IMWRITE_JPEG_PROGRESSIVE, 1}},
                      Form{"jpeg_restarts", ".jpg", CV_8UC3, {cv::IMWRITE_JPEG_RST_INTERVAL, 3}},
                      Form{"png", ".png"},
                      Form{"png_grey", ".png", CV_8UC1},
                      Form{"png_alpha", ".png", CV_8UC4},
                      Form{"png_16", ".png", CV_16UC3},
                      Form{"png_bilevel", ".png", CV_8UC1, {cv::IMWRITE_PNG_BILEVEL, 1}},
                      Form{"tiff", ".tiff"},
                      Form{"tiff_grey", ".tiff", CV_8UC1},
                      Form{"tiff_plain", ".tiff", CV_8UC3, {cv::IMWRITE_TIFF_COMPRESSION, 1}},
                      Form{"tiff_deflate", ".tiff", CV_8UC3, {cv::IMWRITE_TIFF_COMPRESSION, 8}},
                      Form{"tiff_16", ".tiff", CV_16UC3, {}, 1.0},
                      Form{"webp", ".webp"},
                      Form{"webp_lossless", ".webp", CV_8UC3, {cv::IMWRITE_WEBP_QUALITY, 101}},
                      Form{"webp_alpha", ".webp", CV_8UC4, {cv::IMWRITE_WEBP_QUALITY, 101}},
                      Form{"bmp", ".bmp"},
                      Form{"bmp_grey", ".bmp", CV_8UC1},
                      Form{"bmp_alpha", ".bmp", CV_8UC4},
                      Form{"ppm", ".ppm"},
                      Form{"ppm_16", ".ppm", CV_16UC3, {}, 1.0},
                      Form{"pgm", ".pgm", CV_8UC1}),
    [](const auto& each) { return each.param.name; });

TEST_P(EveryForm, GivesThePixelsThatTheOracleGives) {
  const Form& form = GetParam();
  const std::string encoded = Encoded(NoisyImage(form.type), form.extension, form.parameters);
  const auto decoded = DecodePicture(encoded);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_LE(LargestDifference(*decoded, ByOracle(encoded, cv::IMREAD_COLOR)), form.tolerance);
}

TEST_P(EveryForm, IsGreyWhereGreyIsAsked) {
  const Form& form = GetParam();
  const std::string encoded = Encoded(NoisyImage(form.type), form.extension, form.parameters);
  const auto decoded = DecodeGreyPicture(encoded);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  // Decoders that know Y themselves differ by a rounding; colours of JPEG are clipped before.
  EXPECT_LE(LargestDifference(*decoded, ByOracle(encoded, cv::IMREAD_GRAYSCALE)), 3.0);
}

TEST_P(EveryForm, IsRefusedOrWholeWhereverTheFileIsCut) {
  const Form& form = GetParam();
  const std::string whole = Encoded(NoisyImage(form.type), form.extension, form.parameters);
  for (size_t length = 0; length + 8 < whole.size(); length += 1 + whole.size() / 97)
    EXPECT_FALSE(DecodePicture(whole.substr(0, length)).ok()) << length << " of " << whole.size();
}

/// Tiles, several strips, planes apart and a palette, as other programs write TIFF.
struct TiffForm {
  std::string name;
  bool tiled = false;
  int planes = PLANARCONFIG_CONTIG;
  int rows_per_strip = 7;
};

std::string TiffOf(const cv::Mat& rgb, const TiffForm& form, const std::string& path) {
  TIFF* tiff = TIFFOpen(path.c_str(), "w");
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, rgb.cols);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, rgb.rows);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, form.planes);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
  if (form.tiled) {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 64);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, 32);
    for (int y = 0; y < rgb.rows; y += 32)
      for (int x = 0; x < rgb.cols; x += 64) {
        cv::Mat tile = cv::Mat::zeros(32, 64, CV_8UC3);
        const cv::Rect part(x, y, std::min(64, rgb.cols - x), std::min(32, rgb.rows - y));
        rgb(part).copyTo(tile({0, 0, part.width, part.height}));
        TIFFWriteTile(tiff, tile.data, static_cast<uint32_t>(x), static_cast<uint32_t>(y), 0, 0);
      }
  } else {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, form.rows_per_strip);
    std::vector<cv::Mat> planes;
    cv::split(rgb, planes);
    const bool apart = form.planes == PLANARCONFIG_SEPARATE;
    for (uint16_t plane = 0; plane < (apart ? 3 : 1); ++plane)
      for (int y = 0; y < rgb.rows; ++y) {
        cv::Mat row = (apart ? planes[plane] : rgb).row(y).clone();
        TIFFWriteScanline(tiff, row.data, static_cast<uint32_t>(y), plane);
      }
  }
  TIFFClose(tiff);
  return testing::ReadAll(path);
}

TEST(DecodePicture, ReadsTiffsOfAllLayouts) {
  const testing::TemporaryFolder folder;
  const cv::Mat bgr = NoisyImage();
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  for (const TiffForm& form : {TiffForm{"strips"},
                               TiffForm{"one strip", false, PLANARCONFIG_CONTIG, 99},
                               TiffForm{"tiles", true},
                               TiffForm{"planes", false, PLANARCONFIG_SEPARATE}}) {
    const auto decoded = DecodePicture(TiffOf(rgb, form, folder / "a.tif"));
    ASSERT_TRUE(decoded.ok()) << form.name << ": " << decoded.status();
    EXPECT_EQ(LargestDifference(*decoded, bgr), 0.0) << form.name;
  }
}

TEST(DecodePicture, SaysWhichTiffsItDoesNotRead) {
  EXPECT_THAT(ProblemOf(Encoded(cv::Mat::zeros(8, 16, CV_32FC1), ".tiff")),
              HasSubstr("8 or 16 bits"));
}

TEST(DecodePicture, SaysWhichBmpsItDoesNotRead) {
  std::string bmp = Encoded(NoisyImage(), ".bmp");
  bmp[28] = 16;  // bits a pixel
  EXPECT_THAT(ProblemOf(bmp), HasSubstr("make it a PNG"));
}

TEST(DecodePicture, ReadsBmpsFromTheTop) {
  const cv::Mat image = NoisyImage();
  std::string bmp = Encoded(image, ".bmp");
  for (size_t i = 22; i < 26; ++i) bmp[i] = static_cast<char>(i == 22 ? -image.rows : -1);
  cv::Mat upside_down;
  cv::flip(image, upside_down, 0);
  const auto decoded = DecodePicture(bmp);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(LargestDifference(*decoded, upside_down), 0.0);
}

TEST(DecodePicture, StretchesPnmToItsLargestValue) {
  const auto decoded = DecodeGreyPicture("P5 4 2 3\n" + std::string("\0\1\2\3\3\2\1\0", 8));
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  const std::vector<uint8_t> grey(decoded->begin<uint8_t>(), decoded->end<uint8_t>());
  EXPECT_EQ(grey, (std::vector<uint8_t>{0, 85, 170, 255, 255, 170, 85, 0}));
  EXPECT_THAT(ProblemOf("P5 4 2 0\n" + std::string(8, 'x')), HasSubstr("largest value"));
}

TEST(DecodePicture, SeesThatDataAreOfAnotherSizeThanTheHeader) {
  std::string png = Encoded(NoisyImage(), ".png");
  png[19] = static_cast<char>(png[19] - 1);  // the width; the checksum no longer fits either
  EXPECT_FALSE(DecodePicture(png).ok());
}

TEST(DecodePicture, SeesFlippedBitsInAPng) {
  std::string png = Encoded(NoisyImage(), ".png");
  png[png.size() / 2] = static_cast<char>(~png[png.size() / 2]);
  EXPECT_THAT(ProblemOf(png), HasSubstr("the data are damaged ("));
}

}  // namespace
}  // namespace orbweave
