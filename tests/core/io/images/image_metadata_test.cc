// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/image_metadata.h"

#include <gmock/gmock.h>

#include <tuple>

#include "tests/core/io/io_test_support.h"
#include "tests/core/io/tagged_image.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(ReadImageMetadata, GivesTheSizeOfEveryKind) {
  for (const char* extension : {".jpg", ".png", ".tif", ".bmp", ".webp", ".ppm"}) {
    const absl::StatusOr<ImageMetadata> metadata =
        ReadImageMetadata(EncodedImage(64, 32, extension));
    ASSERT_TRUE(metadata.ok()) << extension << ": " << metadata.status();
    EXPECT_EQ(metadata->width_px, 64) << extension;
    EXPECT_EQ(metadata->height_px, 32) << extension;
    EXPECT_FALSE(metadata->position) << extension;
  }
}

TEST(ReadImageMetadata, ReadsPositionPoseAndTime) {
  const std::string bytes =
      Tagged(EncodedImage(64, 32, ".jpg"),
             {{"Exif.GPSInfo.GPSLatitude", "33/1 51/1 2520/100"},
              {"Exif.GPSInfo.GPSLatitudeRef", "S"},
              {"Exif.GPSInfo.GPSLongitude", "151/1 12/1 36/1"},
              {"Exif.GPSInfo.GPSLongitudeRef", "E"},
              {"Exif.GPSInfo.GPSAltitude", "1250/100"},
              {"Exif.GPSInfo.GPSAltitudeRef", "1"},
              {"Exif.GPSInfo.GPSImgDirection", "900/10"},
              {"Exif.GPSInfo.GPSHPositioningError", "32/10"},
              {"Exif.Photo.DateTimeOriginal", "2016:11:13 11:16:31"},
              {"Exif.Photo.SubSecTimeOriginal", "25"}},
             {{"Xmp.GPano.PoseHeadingDegrees", "271.5"}, {"Xmp.GPano.PosePitchDegrees", "-1.25"}});
  const ImageMetadata metadata = ReadImageMetadata(bytes).value();
  ASSERT_TRUE(metadata.position);
  EXPECT_NEAR(metadata.position->latitude_deg, -(33.0 + 51.0 / 60.0 + 25.2 / 3600.0), 1e-12);
  EXPECT_NEAR(metadata.position->longitude_deg, 151.21, 1e-12);
  EXPECT_TRUE(metadata.altitude_known);
  EXPECT_DOUBLE_EQ(metadata.position->altitude_m, -12.5);
  EXPECT_EQ(metadata.position_error_m, 3.2);
  EXPECT_EQ(metadata.heading_deg, 271.5);
  EXPECT_EQ(metadata.pitch_deg, -1.25);
  EXPECT_FALSE(metadata.roll_deg);
  EXPECT_EQ(metadata.capture_time_s, 1479035791.25);
}

TEST(ReadImageMetadata, LeavesOutAPositionThatIsNoneInSilence) {
  for (const char* zero : {"0/0 0/0 0/0", "0/1 0/1 0/1"}) {
    const std::string bytes =
        Tagged(EncodedImage(64, 32, ".jpg"),
               {{"Exif.GPSInfo.GPSLatitude", zero}, {"Exif.GPSInfo.GPSLongitude", zero}});
    EXPECT_FALSE(ReadImageMetadata(bytes).value().position) << zero;
    EXPECT_EQ(ReadImageMetadata(bytes).value().position_problem, "") << zero;
  }
}

/// A small image with a position as text.
std::string AtPosition(const std::string& latitude,
                       const std::string& latitude_letter,
                       const std::string& longitude,
                       const std::string& longitude_letter) {
  return Tagged(EncodedImage(64, 32, ".jpg"),
                {{"Exif.GPSInfo.GPSLatitude", latitude},
                 {"Exif.GPSInfo.GPSLatitudeRef", latitude_letter},
                 {"Exif.GPSInfo.GPSLongitude", longitude},
                 {"Exif.GPSInfo.GPSLongitudeRef", longitude_letter}});
}

TEST(ReadImageMetadata, LeavesOutAPositionThatIsNowhereAndSaysSo) {
  for (const auto& [latitude, longitude, problem] :
       {std::tuple("95/1 0/1 0/1", "10/1 0/1 0/1", "latitude 95, longitude 10"),
        std::tuple("-95/1 0/1 0/1", "10/1 0/1 0/1", "latitude -95, longitude 10"),
        std::tuple("-90/1 -6/1 0/1", "10/1 0/1 0/1", "latitude -90.1, longitude 10"),
        std::tuple("10/1 0/1 0/1", "181/1 0/1 0/1", "latitude 10, longitude 181"),
        std::tuple("10/1 0/1 0/1", "-181/1 0/1 0/1", "latitude 10, longitude -181")}) {
    const ImageMetadata metadata =
        ReadImageMetadata(AtPosition(latitude, "N", longitude, "E")).value();
    EXPECT_FALSE(metadata.position) << latitude;
    EXPECT_EQ(metadata.position_problem, std::string(problem) + " is nowhere on Earth");
  }
}

TEST(ReadImageMetadata, ReadsSecondsOfManyDecimals) {
  // 4294967295 is the largest number that EXIF can hold; as signed it is -1.
  const ImageMetadata metadata =
      ReadImageMetadata(
          AtPosition("47/1 36/1 2147483648/100000000", "N", "8/1 30/1 4294967295/100000000", "W"))
          .value();
  ASSERT_TRUE(metadata.position) << metadata.position_problem;
  EXPECT_NEAR(metadata.position->latitude_deg, 47.6 + 21.47483648 / 3600.0, 1e-12);
  EXPECT_NEAR(metadata.position->longitude_deg, -(8.5 + 42.94967295 / 3600.0), 1e-12);
}

TEST(ReadImageMetadata, TakesTheLettersOfHemispheresInEitherCase) {
  const ImageMetadata metadata =
      ReadImageMetadata(AtPosition("33/1 30/1 0/1", "s", "151/1 0/1 0/1", "w")).value();
  ASSERT_TRUE(metadata.position) << metadata.position_problem;
  EXPECT_EQ(metadata.position->latitude_deg, -33.5);
  EXPECT_EQ(metadata.position->longitude_deg, -151.0);
}

TEST(ReadImageMetadata, LeavesOutAPositionThatContradictsItselfAndSaysSo) {
  for (const auto& [latitude, letter, problem] :
       {std::tuple("47/1 99/1 0/1", "N", "has 99 minutes or seconds"),
        std::tuple("47/1 0/1 61/1", "N", "has 61 minutes or seconds"),
        std::tuple("-47/1 30/1 0/1", "N", "has a part below zero"),
        std::tuple("47/1 30/0 0/1", "N", "its latitude has a number over zero"),
        std::tuple("47/1 30/1 12/0", "N", "its latitude has a number over zero"),
        std::tuple("47/0 30/1 0/1", "N", "its latitude has a number over zero"),
        std::tuple("47/1 30/1 0/1", "X", "latitude is 'X', neither N nor S"),
        std::tuple("47/1 30/1 0/1", "E", "latitude is 'E', neither N nor S"),
        std::tuple("47/1 30/1 0/1", "", "latitude is '', neither N nor S")}) {
    const ImageMetadata metadata =
        ReadImageMetadata(AtPosition(latitude, letter, "8/1 0/1 0/1", "E")).value();
    EXPECT_FALSE(metadata.position) << latitude << letter;
    EXPECT_THAT(metadata.position_problem, ::testing::HasSubstr(problem));
  }
  EXPECT_TRUE(ReadImageMetadata(AtPosition("47/1 59/1 60/1", "N", "8/1 0/1 0/1", "E"))->position);
  // 0/0 stands for "unknown".
  EXPECT_TRUE(
      ReadImageMetadata(AtPosition("47/1 5950/100 0/0", "N", "8/1 0/1 0/1", "E"))->position);
}

TEST(ReadImageMetadata, LeavesOutAPositionThatIsGoodToManyKilometresAndSaysSo) {
  const ImageMetadata metadata =
      ReadImageMetadata(Tagged(AtPosition("47/1 0/1 0/1", "N", "8/1 0/1 0/1", "E"),
                               {{"Exif.GPSInfo.GPSHPositioningError", "20000/1"}}))
          .value();
  EXPECT_FALSE(metadata.position);
  EXPECT_EQ(metadata.position_problem, "it is good to 20 km");
}

TEST(ReadImageMetadata, LeavesOutAnglesHeightsAndAccuraciesThatCannotBe) {
  const std::string bytes = Tagged(AtPosition("47/1 0/1 0/1", "N", "8/1 0/1 0/1", "E"),
                                   {{"Exif.GPSInfo.GPSAltitude", "4294967295/1"},
                                    {"Exif.GPSInfo.GPSHPositioningError", "1/4294967295"}},
                                   {{"Xmp.GPano.PoseHeadingDegrees", "1e30"},
                                    {"Xmp.GPano.PosePitchDegrees", "91"},
                                    {"Xmp.GPano.PoseRollDegrees", "-181"}});
  const ImageMetadata metadata = ReadImageMetadata(bytes).value();
  EXPECT_TRUE(metadata.position);
  EXPECT_FALSE(metadata.altitude_known);
  EXPECT_FALSE(metadata.position_error_m);
  EXPECT_FALSE(metadata.heading_deg || metadata.pitch_deg || metadata.roll_deg);
  EXPECT_THAT(metadata.left_out,
              ElementsAre(Pair("EXIF altitude", HasSubstr("e+09 m")),
                          Pair("heading", "1e+30"),
                          Pair("pitch", "91"),
                          Pair("roll", "-181")));
}

TEST(ReadImageMetadata, NamesAMagneticHeading) {
  const auto tagged = [](const char* reference, const std::string& heading_of_xmp) {
    std::vector<std::pair<std::string, std::string>> xmp;
    if (!heading_of_xmp.empty()) xmp = {{"Xmp.GPano.PoseHeadingDegrees", heading_of_xmp}};
    return ReadImageMetadata(Tagged(EncodedImage(64, 32, ".jpg"),
                                    {{"Exif.GPSInfo.GPSImgDirectionRef", reference},
                                     {"Exif.GPSInfo.GPSImgDirection", "25/2"}},
                                    xmp))
        .value();
  };
  EXPECT_FALSE(tagged("M", "").heading_deg);
  EXPECT_THAT(tagged("M", "").left_out, ElementsAre(Pair("magnetic heading", "12.5")));
  EXPECT_EQ(tagged("T", "").heading_deg, 12.5);
  EXPECT_THAT(tagged("T", "").left_out, IsEmpty());
  EXPECT_EQ(tagged("M", "14").heading_deg, 14.0);
  EXPECT_THAT(tagged("M", "14").left_out, IsEmpty());
  EXPECT_THAT(tagged("T", "north").left_out, ElementsAre(Pair("heading", "nan")));
}

TEST(ReadImageMetadata, KnowsWhichAltitudesAreCountedFromTheEllipsoid) {
  for (const auto& [reference, altitude_m, of_ellipsoid] : {std::tuple("0", 12.5, false),
                                                            std::tuple("1", -12.5, false),
                                                            std::tuple("2", 12.5, true),
                                                            std::tuple("3", -12.5, true)}) {
    const ImageMetadata metadata =
        ReadImageMetadata(Tagged(AtPosition("47/1 0/1 0/1", "N", "8/1 0/1 0/1", "E"),
                                 {{"Exif.GPSInfo.GPSAltitude", "25/2"},
                                  {"Exif.GPSInfo.GPSAltitudeRef", reference}}))
            .value();
    ASSERT_TRUE(metadata.position);
    EXPECT_EQ(metadata.position->altitude_m, altitude_m) << reference;
    EXPECT_EQ(metadata.altitude_of_ellipsoid, of_ellipsoid) << reference;
  }
}

TEST(ReadImageMetadata, RefusesEveryTruncation) {
  for (const char* extension : {".jpg", ".png", ".bmp", ".webp", ".ppm"}) {
    const std::string bytes = EncodedImage(64, 32, extension);
    for (size_t size = 0; size + 2 < bytes.size(); size += 1 + size / 8) {
      EXPECT_FALSE(ReadImageMetadata(std::string_view(bytes).substr(0, size)).ok())
          << extension << " " << size;
    }
    EXPECT_TRUE(ReadImageMetadata(bytes).ok()) << extension;
  }
}

TEST(ReadImageMetadata, SurvivesDamagedHeaders) {
  Random random(5);
  for (const char* extension : {".jpg", ".png", ".tif", ".webp", ".ppm"}) {
    const std::string bytes =
        Tagged(EncodedImage(64, 32, ".jpg"), {{"Exif.GPSInfo.GPSLatitude", "33/1 51/1 2520/100"}});
    const std::string intact =
        extension == std::string(".jpg") ? bytes : EncodedImage(64, 32, extension);
    for (int round = 0; round < 60; ++round) {
      std::string damaged = intact;
      for (int i = 0; i < 4; ++i)
        damaged[random.Index(std::min<uint32_t>(static_cast<uint32_t>(damaged.size()), 400))] =
            static_cast<char>(random.Index(256));
      const absl::StatusOr<ImageMetadata> metadata = ReadImageMetadata(damaged);
      EXPECT_TRUE(!metadata.ok() || metadata->width_px > 0);
    }
  }
}

TEST(ReadImageMetadata, ReadsTheRealCamera) {
  const std::string path =
      std::string(ORBWEAVE_SOURCE_DIR) + "/../shared/data/openmvg_flat360/images/R0010212.JPG";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "the real images are not here";
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const ImageMetadata metadata = ReadImageMetadata(bytes).value();
  EXPECT_EQ(metadata.width_px, 5376);
  EXPECT_EQ(metadata.height_px, 2688);
  ASSERT_TRUE(metadata.position);
  EXPECT_NEAR(metadata.position->latitude_deg, 47.6101944444444, 1e-9);
  EXPECT_NEAR(metadata.position->longitude_deg, -122.323852777778, 1e-9);
  EXPECT_DOUBLE_EQ(metadata.position->altitude_m, 60.0);
  EXPECT_EQ(metadata.heading_deg, 180.0);
  EXPECT_EQ(metadata.pitch_deg, 0.9);
  EXPECT_EQ(metadata.roll_deg, 0.4);
  EXPECT_EQ(metadata.capture_time_s, 1479035791.0);
}

}  // namespace
}  // namespace orbweave
