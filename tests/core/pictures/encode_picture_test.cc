// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pictures/encode_picture.h"

#include <gtest/gtest.h>

#include "core/pictures/decode_picture.h"
#include "tests/core/pictures/encoded_images.h"
#include "tests/core/pictures/noisy_image.h"

namespace orbweave {
namespace {

TEST(EncodeJpeg, WritesTheBytesThatTheOracleWrites) {
  for (const int type : {CV_8UC3, CV_8UC1}) {
    for (const int quality : {30, 90, 98}) {
      const cv::Mat image = NoisyImage(type);
      EXPECT_EQ(*EncodeJpeg(image, quality),
                Encoded(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality}));
    }
  }
}

TEST(EncodePng, IsDecodedToTheSamePixels) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4}) {
    const cv::Mat image = NoisyImage(type);
    const std::string encoded = *EncodePng(image);
    const std::vector<uint8_t> bytes(encoded.begin(), encoded.end());
    const cv::Mat decoded = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(decoded.type(), type);
    EXPECT_EQ(cv::norm(decoded, image, cv::NORM_INF), 0.0);
  }
}

TEST(EncodePng, TakesAPartOfAnImage) {
  const cv::Mat part = NoisyImage()({10, 20, 50, 25});
  EXPECT_EQ(cv::norm(*DecodePicture(*EncodePng(part)), part, cv::NORM_INF), 0.0);
  EXPECT_TRUE(EncodeJpeg(part, 90).ok());
}

TEST(EncodePicture, SaysThatNothingCannotBeEncoded) {
  EXPECT_FALSE(EncodeJpeg(cv::Mat(0, 0, CV_8UC3), 90).ok());
  EXPECT_FALSE(EncodePng(cv::Mat(0, 0, CV_8UC3)).ok());
}

}  // namespace
}  // namespace orbweave
