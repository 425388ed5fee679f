// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/ingest_images/ingest_images.h"

#include <absl/strings/str_format.h>
#include <absl/strings/str_replace.h>
#include <absl/strings/str_split.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <tuple>

#include "core/io/images/scan_image_folder.h"
#include "core/scene/local_frame.h"
#include "core/scene/sequence_of_drive.h"
#include "stages/ingest_images/count_from_ellipsoid.h"
#include "stages/ingest_images/ingest_options.h"
#include "tests/core/io/geoid_grid.h"
#include "tests/core/io/io_test_support.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// `count` good sources "img0.jpg", ... of 2048x1024, each of its own content.
ImageSources GoodSources(int count) {
  ImageSources sources;
  for (int i = 0; i < count; ++i) {
    SourceImage image;
    image.name = "img" + std::to_string(i) + ".jpg";
    image.content = DigestOf(image.name);
    image.metadata.width_px = 2048;
    image.metadata.height_px = 1024;
    sources.images.push_back(image);
  }
  return sources;
}

ImageManifest Ingest(const ImageSources& sources, const IngestOptions& options = {}) {
  const absl::StatusOr<ImageManifest> manifest = IngestImages(sources, options, {});
  EXPECT_TRUE(manifest.ok()) << manifest.status();
  return manifest.value_or(ImageManifest{});
}

TEST(IngestImages, NumbersImagesInNaturalOrder) {
  ImageSources sources = GoodSources(12);
  std::reverse(sources.images.begin(), sources.images.end());
  const ImageManifest manifest = Ingest(sources);
  ASSERT_EQ(manifest.images.size(), 12U);
  for (uint32_t i = 0; i < 12; ++i) {
    EXPECT_EQ(manifest.images[i].id, ImageId(i));
    EXPECT_EQ(manifest.images[i].name, "img" + std::to_string(i) + ".jpg");
    EXPECT_EQ(manifest.images[i].drive, 0U);
  }
  EXPECT_FALSE(manifest.origin);
  EXPECT_THAT(manifest.excluded, IsEmpty());
  EXPECT_THAT(manifest.warnings, IsEmpty());
}

TEST(IngestImages, ExcludesWithReasons) {
  ImageSources sources = GoodSources(6);
  sources.images[1].problem = "truncated: the data end after 100 bytes, before the image does";
  sources.images[2].metadata.height_px = 1536;
  sources.images[4].content = sources.images[0].content;
  sources.images[5].metadata.width_px = 1025;  // one pixel off, another size: allowed
  sources.images[5].metadata.height_px = 512;
  const ImageManifest manifest = Ingest(sources);
  ASSERT_EQ(manifest.images.size(), 3U);
  EXPECT_EQ(manifest.images[2].name, "img5.jpg");
  EXPECT_EQ(manifest.images[2].camera.width_px, 1025);
  ASSERT_EQ(manifest.excluded.size(), 3U);
  EXPECT_THAT(manifest.excluded[0].reason, HasSubstr("truncated"));
  EXPECT_THAT(manifest.excluded[1].reason, HasSubstr("2048x1536, not 2:1"));
  EXPECT_EQ(manifest.excluded[2].name, "img4.jpg");
  EXPECT_THAT(manifest.excluded[2].reason, HasSubstr("copy of img0.jpg"));
}

TEST(IngestImages, FailsWhenNothingIsLeft) {
  ImageSources sources = GoodSources(2);
  for (SourceImage& image : sources.images) image.metadata.width_px = 1024;
  const absl::Status status = IngestImages(sources, {}, {}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(status.message(),
              HasSubstr("none of the 2 images can be used; img0.jpg: it is 1024x1024, not 2:1"));
}

TEST(IngestImages, JoinsTheTableAndFillsTheLocalFrame) {
  ImageSources sources = GoodSources(4);
  sources.gnss_name = "gnss.csv";
  sources.gnss_text =
      "name,latitude,longitude,altitude,accuracy,heading\n"
      "img0.jpg,47.61,-122.32,60,0.1,90\nother/"
      "img1.jpg,47.6101,-122.32,61,,\nimg2,47.6102,-122.32,62,,\nimg9.jpg,47,-122,0,,\nimg3.jpg,0,"
      "0,0,,\n";
  const ImageManifest manifest = Ingest(sources);
  ASSERT_TRUE(manifest.origin);
  EXPECT_LT(EnuFromGeodetic(*manifest.origin, {47.6101, -122.32, 61.0}).norm(), 100.0);
  const PosePrior& prior = manifest.images[0].prior;
  EXPECT_DOUBLE_EQ(prior.horizontal_sigma_m, 0.1);
  EXPECT_DOUBLE_EQ(prior.vertical_sigma_m, 0.2);
  EXPECT_EQ(prior.heading_deg, 90.0);
  const Eigen::Vector3d step = *manifest.images[1].prior.position_in_enu - *prior.position_in_enu;
  EXPECT_NEAR(step.x(), 0.0, 0.01);
  EXPECT_NEAR(step.y(), 11.118, 0.01);
  EXPECT_NEAR(step.z(), 1.0, 0.01);
  EXPECT_DOUBLE_EQ(manifest.images[1].prior.horizontal_sigma_m, 5.0);
  EXPECT_DOUBLE_EQ(manifest.images[1].prior.vertical_sigma_m, 10.0);
  EXPECT_TRUE(manifest.images[2].prior.position_in_enu);
  EXPECT_FALSE(manifest.images[3].prior.geodetic);
  EXPECT_THAT(manifest.warnings,
              ElementsAre("gnss.csv line 6 (img3.jpg) is not used: its position is 0/0, as "
                          "receivers write without a fix",
                          "1 row of gnss.csv has no image: img9.jpg",
                          "1 image has no row in gnss.csv: img3.jpg"));
}

TEST(IngestImages, UsesExifWhereTheTableIsSilent) {
  ImageSources sources = GoodSources(3);
  sources.images[1].metadata.position = GeodeticPosition{47.61, -122.3201, 0.0};
  sources.images[1].metadata.heading_deg = 12.0;
  sources.images[1].metadata.capture_time_s = 100.0;
  sources.gnss_name = "gnss.csv";
  sources.gnss_text = "name,latitude,longitude,altitude\nimg0.jpg,47.61,-122.32,60\n";
  const ImageManifest manifest = Ingest(sources);
  const PosePrior& prior = manifest.images[1].prior;
  ASSERT_TRUE(prior.position_in_enu);
  EXPECT_NEAR(prior.position_in_enu->z(), 0.0,
              1e-3);  // unknown altitude: that of the others
  EXPECT_FALSE(IsHeightKnown(prior.vertical_sigma_m));
  EXPECT_EQ(prior.heading_deg, 12.0);
  EXPECT_EQ(manifest.images[1].capture_time_s, 100.0);
}

TEST(IngestImages, SeesATableSwappedAgainstExif) {
  ImageSources sources = GoodSources(2);
  for (SourceImage& image : sources.images)
    image.metadata.position = GeodeticPosition{48.85, 2.35, 35.0};
  sources.gnss_name = "paris.csv";
  sources.gnss_text = "name,latitude,longitude\nimg0.jpg,2.35,48.85\nimg1.jpg,2.3501,48.8501\n";
  const absl::Status status = IngestImages(sources, {}, {}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(status.message(), HasSubstr("look swapped"));
}

TEST(IngestImages, DropsAPositionOnAnotherContinent) {
  ImageSources sources = GoodSources(5);
  for (size_t i = 0; i < 5; ++i) {
    const double along_deg = 1.2345e-5 * static_cast<double>(i);
    sources.images[i].metadata.position = GeodeticPosition{48.85, 2.35 + along_deg, 35.0 + 0.1 * i};
    sources.images[i].metadata.altitude_known = true;
  }
  sources.images[3].metadata.position->longitude_deg = 92.35;
  const ImageManifest manifest = Ingest(sources);
  EXPECT_FALSE(manifest.images[3].prior.geodetic || manifest.images[3].prior.position_in_enu);
  EXPECT_TRUE(manifest.images[4].prior.position_in_enu);
  EXPECT_THAT(manifest.warnings, ElementsAre(HasSubstr("img3.jpg")));
}

TEST(IngestImages, TreatsTheDateLineLikeAnyOtherPlace) {
  ImageSources sources = GoodSources(4);
  for (size_t i = 0; i < 4; ++i)
    sources.images[i].metadata.position =
        GeodeticPosition{-17.0, i % 2 == 0 ? 179.9999 : -179.9999, 10.0};
  const ImageManifest manifest = Ingest(sources);
  for (const ImageRecord& image : manifest.images)
    EXPECT_LT(image.prior.position_in_enu->norm(), 200.0) << image.name;
}

TEST(IngestImages, TakesLocalMetresAsTheyAre) {
  ImageSources sources = GoodSources(2);
  sources.images[1].metadata.position =
      GeodeticPosition{48.85, 2.35, 35.0};  // another frame: not mixed in
  sources.gnss_name = "truth.csv";
  sources.gnss_text = "name,x,y,z\nimg0.jpg,10,20,30\n";
  const ImageManifest manifest = Ingest(sources);
  EXPECT_FALSE(manifest.origin);
  EXPECT_EQ(*manifest.images[0].prior.position_in_enu, Eigen::Vector3d(10, 20, 30));
  EXPECT_FALSE(manifest.images[1].prior.position_in_enu);
}

TEST(IngestImages, BeginsADriveAfterALongPause) {
  ImageSources sources = GoodSources(5);
  const double times_s[5] = {0.0, 500.0, 1000.0, 2000.0, 2100.0};
  for (size_t i = 0; i < 5; ++i) sources.images[i].metadata.capture_time_s = times_s[i];
  sources.images[1].metadata.capture_time_s.reset();
  IngestOptions options;
  options.drive_gap_s = 999.0;
  std::vector<uint32_t> drives;
  for (const ImageRecord& image : Ingest(sources, options).images) drives.push_back(image.drive);
  EXPECT_THAT(drives, ElementsAre(0, 0, 1, 2, 2));
}

std::vector<uint32_t> DrivesOf(const ImageManifest& manifest) {
  std::vector<uint32_t> drives;
  for (const ImageRecord& image : manifest.images) drives.push_back(image.drive);
  return drives;
}

TEST(IngestImages, TheTableNeedNotHaveARowForEveryImageOfADrive) {
  ImageSources sources = GoodSources(10);
  sources.gnss_name = "gnss.csv";
  sources.gnss_text =
      "name,x,y,z,drive\nimg1.jpg,0,0,0,west\nimg3.jpg,1,0,0,west\nimg6.jpg,2,0,0,east\n"
      "img8.jpg,3,0,0,east\n";
  // Between two drives nothing tells of which an image is.
  EXPECT_THAT(DrivesOf(Ingest(sources)), ElementsAre(0, 0, 0, 0, 1, 1, 2, 2, 2, 2));
  sources.gnss_text = "name,x,y,z,drive\nimg3.jpg,0,0,0,west\nimg5.jpg,1,0,0,west\n";
  // Others may be of a drive that the table has nothing of.
  EXPECT_THAT(DrivesOf(Ingest(sources)), ElementsAre(0, 0, 0, 1, 1, 1, 0, 0, 0, 0));
}

TEST(IngestImages, FindsDrivesByTimeWhereNamesAreInAnotherOrder) {
  // Two drives a day apart, whose pictures are named by chance.
  ImageSources sources = GoodSources(6);
  const double times_s[6] = {0.0, 86400.0, 20.0, 86420.0, 10.0, 86410.0};
  for (size_t i = 0; i < 6; ++i) sources.images[i].metadata.capture_time_s = times_s[i];
  EXPECT_THAT(DrivesOf(Ingest(sources)), ElementsAre(0, 1, 0, 1, 0, 1));
}

TEST(IngestImages, OneImageWithoutATimeLeavesTheOthersInOrder) {
  // Two drives a day apart, the later one first by name.
  ImageSources sources = GoodSources(6);
  const double times_s[6] = {86400.0, 86410.0, 86420.0, 0.0, 10.0, 20.0};
  for (size_t i = 0; i < 6; ++i) sources.images[i].metadata.capture_time_s = times_s[i];
  sources.images[4].metadata.capture_time_s.reset();
  ImageManifest manifest = Ingest(sources);
  EXPECT_THAT(DrivesOf(manifest), ElementsAre(0, 0, 0, 1, 1, 1));
  EXPECT_THAT(manifest.warnings, IsEmpty());
  // Between the last of one drive and the first of the other by name, which is no place by time.
  sources.images[4].metadata.capture_time_s = times_s[4];
  sources.images[3].metadata.capture_time_s.reset();
  manifest = Ingest(sources);
  EXPECT_THAT(DrivesOf(manifest), ElementsAre(0, 0, 0, 0, 1, 1));
  EXPECT_THAT(manifest.warnings,
              ElementsAre(AllOf(HasSubstr("no capture time"), HasSubstr(": img3.jpg"))));
}

TEST(IngestImages, NamesImagesOfALabelledDriveThatNothingPlaces) {
  ImageSources sources = GoodSources(4);
  sources.gnss_name = "gnss.csv";
  sources.gnss_text =
      "name,x,y,z,drive,time\nimg0.jpg,0,0,1,a,30\nimg1.jpg,1,0,2,a,\nimg2.jpg,2,0,1,a,10\n"
      "img3.jpg,3,0,2,a,\n";
  EXPECT_THAT(Ingest(sources).warnings, ElementsAre(HasSubstr(": img1.jpg, img3.jpg")));
}

TEST(IngestImages, AnImageWithoutARowStaysBetweenItsNeighboursByName) {
  ImageSources sources = GoodSources(4);
  for (SourceImage& image : sources.images) image.metadata.capture_time_s = 7200.0;  // local time
  sources.gnss_name = "gnss.csv";
  sources.gnss_text =
      "name,x,y,z,time\nimg0.jpg,0,0,0,100\nimg2.jpg,2,0,0,102\nimg3.jpg,3,0,0,2\n"
      "img9.jpg,0,0,0,1\n";
  sources.images[0].metadata.capture_time_s.reset();
  const ImageManifest manifest = Ingest(sources);
  EXPECT_FALSE(manifest.images[1].capture_time_s);
  EXPECT_EQ(SequenceOfDrives(manifest).at(0),
            (std::vector<ImageId>{ImageId(3), ImageId(0), ImageId(1), ImageId(2)}));
}

TEST(IngestImages, KeepsApartFoldersOfTwoCamerasWhereOnePictureHasNoTime) {
  ImageSources sources = GoodSources(6);
  for (size_t i = 0; i < 6; ++i) {
    sources.images[i].name = (i < 3 ? "a/" : "b/") + sources.images[i].name;
    sources.images[i].metadata.capture_time_s = 10.0 * static_cast<double>(i % 3);
  }
  sources.images[4].metadata.capture_time_s.reset();
  EXPECT_THAT(DrivesOf(Ingest(sources)), ElementsAre(0, 0, 0, 1, 1, 1));
}

TEST(IngestImages, KeepsApartFoldersOfTwoCamerasThatWereOnTheWayAtOnce) {
  ImageSources sources = GoodSources(6);
  for (size_t i = 0; i < 6; ++i) {
    sources.images[i].name = (i < 3 ? "a/" : "b/") + sources.images[i].name;
    sources.images[i].metadata.capture_time_s = 10.0 * static_cast<double>(i % 3);
  }
  EXPECT_THAT(DrivesOf(Ingest(sources)), ElementsAre(0, 0, 0, 1, 1, 1));
  // One after the other they are two folders of one drive.
  for (size_t i = 3; i < 6; ++i) *sources.images[i].metadata.capture_time_s += 20.0;
  EXPECT_THAT(DrivesOf(Ingest(sources)), ElementsAre(0, 0, 0, 0, 0, 0));
}

TEST(IngestImages, DoesNotMixTheClocksOfTableAndExif) {
  ImageSources sources = GoodSources(3);
  for (size_t i = 0; i < 3; ++i)
    sources.images[i].metadata.capture_time_s = 7200.0 + static_cast<double>(i);  // local time
  sources.gnss_name = "gnss.csv";
  sources.gnss_text = "name,latitude,longitude,time\nimg0.jpg,47,8,0\nimg1.jpg,47,8,1\n";
  EXPECT_EQ(Ingest(sources).images[0].capture_time_s, 7200.0);
  sources.gnss_text += "img2.jpg,47,8,2\n";
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(Ingest(sources).images[i].capture_time_s, static_cast<double>(i));
}

TEST(IngestImages, TakesAccuraciesAsStatedElseByFixTypeElseByOption) {
  ImageSources sources = GoodSources(5);
  sources.gnss_name = "gnss.csv";
  sources.gnss_text =
      "name,latitude,longitude,altitude,accuracy,vertical_accuracy,fix\n"
      "img0.jpg,47.1234561,8,400,0.25,0.75,float\nimg1.jpg,47.1234562,8,400,,,fixed\n"
      "img2.jpg,47.1234563,8,400,,7,1\nimg3.jpg,47.1234564,8,400,0.25,,\n"
      "img4.jpg,47.1234565,8,400,0.01,,none\n";
  const ImageManifest manifest = Ingest(sources);
  const auto expect_sigmas = [&](size_t i, double horizontal_m, double vertical_m) {
    EXPECT_TRUE(manifest.images[i].prior.position_in_enu) << i;
    EXPECT_DOUBLE_EQ(manifest.images[i].prior.horizontal_sigma_m, horizontal_m) << i;
    EXPECT_DOUBLE_EQ(manifest.images[i].prior.vertical_sigma_m, vertical_m) << i;
  };
  expect_sigmas(0, 0.25, 0.75);
  expect_sigmas(1, 0.05, 0.1);
  expect_sigmas(2, 5.0, 7.0);
  expect_sigmas(3, 0.25, 0.5);
  EXPECT_FALSE(manifest.images[4].prior.position_in_enu || manifest.images[4].prior.geodetic);
  EXPECT_THAT(manifest.warnings,
              ElementsAre("1 row of gnss.csv has no fix: its position is not used: line 6 "
                          "('none')"));
}

TEST(IngestImages, DoesNotTakeThePositionOfExifWhereTheTableHasNoFix) {
  ImageSources sources = GoodSources(2);
  sources.images[1].metadata.position = GeodeticPosition{47.0, 8.0, 400.0};
  sources.gnss_name = "gnss.csv";
  sources.gnss_text = "name,x,y,z,fix\nimg1.jpg,1,2,3,none\nimg0.jpg,1,2,3,4\n";
  const ImageManifest manifest = Ingest(sources);
  EXPECT_TRUE(manifest.images[0].prior.position_in_enu);
  EXPECT_FALSE(manifest.images[1].prior.position_in_enu || manifest.images[1].prior.geodetic);
}

TEST(IngestImages, GivesDirectionsTheirAccuracies) {
  ImageSources sources = GoodSources(3);
  for (size_t i = 0; i < 3; ++i) {
    sources.images[i].metadata.heading_deg = 10.0 * static_cast<double>(i);
    sources.images[i].metadata.pitch_deg = 0.5 * static_cast<double>(i);
    sources.images[i].metadata.roll_deg = -0.5 * static_cast<double>(i);
  }
  sources.gnss_name = "gnss.csv";
  sources.gnss_text =
      "name,latitude,longitude,heading,heading_accuracy,pitch,pitch_accuracy,roll_accuracy\n"
      "img0.jpg,47,8,91,0.25,2,0.125,0.5\nimg1.jpg,47,8,,0.25,,0.125,\n";
  IngestOptions options;
  options.heading_sigma_deg = 20.0;
  const ImageManifest manifest = Ingest(sources, options);
  const PosePrior& of_table = manifest.images[0].prior;
  EXPECT_EQ(of_table.heading_deg, 91.0);
  EXPECT_EQ(of_table.heading_sigma_deg, 0.25);
  EXPECT_EQ(of_table.pitch_deg, 2.0);
  EXPECT_EQ(of_table.tilt_sigma_deg, 0.5);
  for (size_t i = 1; i < 3; ++i) {  // the table's accuracies are not those of EXIF's angles
    const PosePrior& of_exif = manifest.images[i].prior;
    EXPECT_EQ(of_exif.heading_deg, 10.0 * static_cast<double>(i));
    EXPECT_EQ(of_exif.roll_deg, -0.5 * static_cast<double>(i));
    EXPECT_EQ(of_exif.heading_sigma_deg, 20.0);
    EXPECT_EQ(of_exif.tilt_sigma_deg, 3.0);
  }
}

TEST(CountFromEllipsoid, TurnsTheAltitudesThatAreKnown) {
  const TemporaryFolder folder;
  folder.Write("egm2008-5.pgm", GeoidGrid(47.25));
  ImageManifest manifest;
  manifest.images.resize(3);
  manifest.images[0].prior.geodetic = GeodeticPosition{47.0, 8.0, 400.0};
  manifest.images[1].prior.geodetic = GeodeticPosition{47.0, 8.0, std::nan("")};
  ASSERT_TRUE(CountFromEllipsoid(HeightDatum::kEgm2008, {}, manifest, folder.path()).ok());
  EXPECT_NEAR(manifest.images[0].prior.geodetic->altitude_m, 447.25, 1e-9);
  EXPECT_TRUE(std::isnan(manifest.images[1].prior.geodetic->altitude_m));
  EXPECT_THAT(manifest.warnings, IsEmpty());
  ASSERT_TRUE(CountFromEllipsoid(HeightDatum::kEllipsoid, {}, manifest, folder.path()).ok());
  EXPECT_NEAR(manifest.images[0].prior.geodetic->altitude_m, 447.25, 1e-9);
  manifest.images.resize(0);
  ASSERT_TRUE(CountFromEllipsoid(HeightDatum::kEgm2008, {}, manifest, folder.path()).ok());
  EXPECT_THAT(manifest.warnings, ElementsAre(HasSubstr("changes nothing")));
}

TEST(IngestImages, CountsAltitudesFromTheGeoidThatIsAskedFor) {
  ImageSources sources = GoodSources(2);
  for (SourceImage& image : sources.images) {
    image.metadata.position = GeodeticPosition{47.0, 8.0, 400.0};
    image.metadata.altitude_known = true;
  }
  const TemporaryFolder folder;
  ASSERT_EQ(::setenv("GEOGRAPHICLIB_GEOID_PATH", folder.path().c_str(), 1), 0);
  IngestOptions options;
  options.height = HeightDatum::kEgm96;
  EXPECT_EQ(IngestImages(sources, options, {}).status().code(),
            absl::StatusCode::kFailedPrecondition);
  folder.Write("egm96-5.pgm", GeoidGrid(-20.5));
  EXPECT_NEAR(Ingest(sources, options).images[1].prior.geodetic->altitude_m, 379.5, 1e-9);
  // Who says that it is counted from the ellipsoid is believed, but for the table's altitudes.
  sources.images[1].metadata.altitude_of_ellipsoid = true;
  EXPECT_NEAR(Ingest(sources, options).images[0].prior.geodetic->altitude_m, 379.5, 1e-9);
  EXPECT_NEAR(Ingest(sources, options).images[1].prior.geodetic->altitude_m, 400.0, 1e-9);
  sources.gnss_name = "gnss.csv";
  sources.gnss_text = "name,latitude,longitude,altitude\nimg1.jpg,47,8,400\n";
  EXPECT_NEAR(Ingest(sources, options).images[1].prior.geodetic->altitude_m, 379.5, 1e-9);
  ASSERT_EQ(::unsetenv("GEOGRAPHICLIB_GEOID_PATH"), 0);
}

TEST(IngestImages, DoesNotTakeForMeasuredWhatEveryImageSays) {
  ImageSources sources = GoodSources(4);
  for (size_t i = 0; i < 3; ++i) {
    sources.images[i].metadata.heading_deg = 180.0;
    sources.images[i].metadata.pitch_deg = 0.1 * static_cast<double>(i);
    sources.images[i].metadata.roll_deg = 12.0;  // leans: stated by nobody who does not know
  }
  ImageManifest manifest = Ingest(sources);
  EXPECT_FALSE(manifest.images[0].prior.heading_deg);
  EXPECT_EQ(manifest.images[1].prior.pitch_deg, 0.1);
  EXPECT_EQ(manifest.images[2].prior.roll_deg, 12.0);
  EXPECT_THAT(manifest.warnings, ElementsAre(HasSubstr("state a heading state exactly 180")));
  for (SourceImage& image : sources.images) {
    image.metadata.pitch_deg = 0.0;
    image.metadata.roll_deg = 0.0;
  }
  manifest = Ingest(sources);
  EXPECT_THAT(manifest.warnings,
              ElementsAre(HasSubstr("state a pitch or a roll state exactly 0 degrees"),
                          HasSubstr("state a heading state exactly 180")));
  // Who states an accuracy means it.
  sources.gnss_name = "gnss.csv";
  sources.gnss_text = "name,latitude,longitude,heading_accuracy\nimg0.jpg,47,8,1\n";
  manifest = Ingest(sources);
  EXPECT_EQ(manifest.images[0].prior.heading_deg, 180.0);
}

/// A table of `count` images along a street that climbs, at 4 m steps.
std::string StreetTable(size_t count, const char* columns = "name,latitude,longitude,altitude\n") {
  std::string text = columns;
  for (size_t i = 0; i < count; ++i) {
    text += absl::StrFormat("img%d.jpg,%.7f,%.7f,%.1f\n",
                            i,
                            47.1234567 + 3.7e-5 * static_cast<double>(i),
                            8.7654321,
                            400.5 + 0.3 * static_cast<double>(i));
  }
  return text;
}

TEST(IngestImages, DoesNotTakeForAHeightWhatEveryPositionStates) {
  ImageSources sources = GoodSources(6);
  sources.gnss_name = "gnss.csv";
  sources.gnss_text = StreetTable(6);
  EXPECT_TRUE(IsHeightKnown(Ingest(sources).images[3].prior.vertical_sigma_m));
  for (size_t i = 0; i < 6; ++i) {
    const std::string height = absl::StrFormat(",%.1f\n", 400.5 + 0.3 * static_cast<double>(i));
    absl::StrReplaceAll({{height, ",0\n"}}, &sources.gnss_text);
  }
  ImageManifest manifest = Ingest(sources);
  for (const ImageRecord& image : manifest.images)
    EXPECT_FALSE(IsHeightKnown(image.prior.vertical_sigma_m)) << image.name;
  EXPECT_THAT(manifest.warnings,
              ElementsAre(HasSubstr("6 positions state a height of exactly 0 m"),
                          HasSubstr("none of the 6 positions has a height")));
  // Local metres of a plan.
  sources.gnss_text = "name,x,y,z\nimg0.jpg,0.1,0,2.5\nimg1.jpg,4.2,0,2.5\nimg2.jpg,8.1,0,2.5\n";
  manifest = Ingest(sources);
  EXPECT_FALSE(IsHeightKnown(manifest.images[1].prior.vertical_sigma_m));
  EXPECT_EQ(manifest.images[1].prior.position_in_enu->x(), 4.2);
  // Who states an accuracy means it.
  sources.gnss_text =
      "name,x,y,z,vertical_accuracy\nimg0.jpg,0.1,0,2.5,0.1\n"
      "img1.jpg,4.2,0,2.5,0.1\nimg2.jpg,8.1,0,2.5,0.1\n";
  EXPECT_EQ(Ingest(sources).images[1].prior.vertical_sigma_m, 0.1);
}

TEST(IngestImages, TakesNoughtForAHeightOnlyWhereOthersAreNearIt) {
  ImageSources sources = GoodSources(6);
  sources.gnss_name = "gnss.csv";
  const auto known_with = [&](const char* heights) {
    const std::vector<std::string> each = absl::StrSplit(heights, ' ');
    sources.gnss_text = "name,latitude,longitude,altitude\n";
    for (size_t i = 0; i < 6; ++i)
      sources.gnss_text += absl::StrFormat("img%d.jpg,47.1234%d67,8.7654321,%s\n", i, i, each[i]);
    std::string known;
    for (const ImageRecord& image : Ingest(sources).images)
      known += IsHeightKnown(image.prior.vertical_sigma_m) ? '1' : '0';
    return known;
  };
  EXPECT_EQ(known_with("0 0 0 400.1 400.3 399.8"), "000111");
  EXPECT_EQ(known_with("0 0 0 1 2 2"), "111111") << "beside the sea";
  EXPECT_EQ(known_with("0 0 398 400.1 400.3 399.8"), "111111") << "too few to tell";
}

TEST(IngestImages, UsesTheFirstOfPositionsThatRepeat) {
  ImageSources sources = GoodSources(9);
  sources.gnss_name = "gnss.csv";
  sources.gnss_text = "name,latitude,longitude,altitude\n";
  for (size_t i = 0; i < 9; ++i) {
    sources.gnss_text += absl::StrFormat("img%d.jpg,47.1234%d67,8.7654321,%.1f\n",
                                         i,
                                         i / 3,
                                         400.5 + 0.3 * static_cast<double>(i / 3));
  }
  ImageManifest manifest = Ingest(sources);
  for (size_t i = 0; i < 9; ++i)
    EXPECT_EQ(manifest.images[i].prior.position_in_enu.has_value(), i % 3 == 0) << i;
  EXPECT_THAT(manifest.warnings,
              ElementsAre(HasSubstr("6 positions repeat that of the image before")));
}

TEST(IngestImages, SharesPositionsThatAreOfOneTime) {
  ImageSources sources = GoodSources(6);
  sources.gnss_name = "gnss.csv";
  sources.gnss_text = "name,latitude,longitude,altitude,time\n";
  for (size_t i = 0; i < 6; ++i) {  // two cameras on one car
    sources.gnss_text += absl::StrFormat("img%d.jpg,47.1234%d67,8.7654321,%.1f,%d\n",
                                         i,
                                         i / 2,
                                         400.5 + 0.3 * static_cast<double>(i / 2),
                                         1700000000 + i / 2);
  }
  for (const ImageRecord& image : Ingest(sources).images)
    EXPECT_TRUE(image.prior.position_in_enu) << image.name;
}

TEST(IngestImages, KnowsHowFarPositionsAreRounded) {
  ImageSources sources = GoodSources(8);
  sources.gnss_name = "gnss.csv";
  const auto ingest_at = [&](double step_deg, const char* format) {
    sources.gnss_text = "name,latitude,longitude,altitude,accuracy\n";
    for (int i = 0; i < 8; ++i) {
      const double latitude_deg = std::round((47.12345 + 6e-5 * i) / step_deg) * step_deg;
      sources.gnss_text += absl::StrFormat("img%d.jpg,", i);
      sources.gnss_text += absl::StrFormat(*absl::ParsedFormat<'f'>::New(format), latitude_deg);
      sources.gnss_text += absl::StrFormat(",8.7654,%.1f,1\n", 400.5 + 0.3 * i);
    }
    return Ingest(sources);
  };
  for (const auto& [step_deg, format, step_m] :
       {std::tuple(1e-4, "%.4f", 11.13), std::tuple(1e-5, "%.5f", 1.113)}) {
    const ImageManifest manifest = ingest_at(step_deg, format);
    for (const ImageRecord& image : manifest.images) {
      ASSERT_TRUE(image.prior.position_in_enu) << image.name << " " << step_deg;
      EXPECT_NEAR(image.prior.horizontal_sigma_m, std::hypot(1.0, step_m / std::sqrt(12.0)), 0.01);
    }
  }
}

TEST(IngestImages, FollowsTheTablesDrives) {
  ImageSources sources = GoodSources(4);
  sources.gnss_name = "gnss.csv";
  sources.gnss_text =
      "name,x,y,z,drive\nimg0.jpg,0,0,0,west\nimg1.jpg,1,0,0,east\nimg3.jpg,2,0,0,west\n";
  std::vector<uint32_t> drives;
  for (const ImageRecord& image : Ingest(sources).images) drives.push_back(image.drive);
  EXPECT_THAT(drives, ElementsAre(0, 1, 2, 0));
}

TEST(IngestImages, DoesNotUseAMaskOfOtherProportions) {
  ImageSources sources = GoodSources(4);
  for (SourceImage& image : sources.images) {
    image.mask_path = "/masks/" + image.name + ".png";
    image.mask = DigestOf("mask of " + image.name);
    image.mask_width_px = 2048;
    image.mask_height_px = 1024;
  }
  sources.images[1].mask_width_px = 1024;
  sources.images[2].mask_width_px = 0;
  sources.images[3].mask_width_px = 1280;  // scaled: the same panorama
  sources.images[3].mask_height_px = 640;
  const ImageManifest manifest = Ingest(sources);
  EXPECT_EQ(manifest.images[0].mask, sources.images[0].mask);
  EXPECT_TRUE(manifest.images[1].mask.IsZero());
  EXPECT_TRUE(manifest.images[2].mask.IsZero());
  EXPECT_EQ(manifest.images[3].mask, sources.images[3].mask);
  EXPECT_THAT(
      manifest.warnings,
      ElementsAre(HasSubstr("is 1024x1024, its image 2048x1024"), HasSubstr("cannot be read")));
}

TEST(IngestImages, NamesTheWrongOption) {
  IngestOptions options;
  options.gnss_sigma_m = -1.0;
  EXPECT_THAT(IngestImages(GoodSources(1), options, {}).status().message(),
              HasSubstr("ingest.gnss_sigma_m"));
}

TEST(IngestImages, TakesAFolderOfRealFiles) {
  const std::string data = std::string(ORBWEAVE_SOURCE_DIR) + "/../shared/data/openmvg_flat360";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the real images are not here";
  const ImageSources sources =
      ScanImageFolder({.image_folder = data + "/images", .gnss_table = data + "/gnss.csv"},
                      {.num_threads = 2})
          .value();
  const ImageManifest manifest = Ingest(sources);
  ASSERT_EQ(manifest.images.size(), 11U);
  EXPECT_EQ(manifest.images[0].name, "R0010210.JPG");
  EXPECT_THAT(manifest.warnings,
              ElementsAre(HasSubstr("11 positions state a height of exactly 60 m"),
                          HasSubstr("none of the 11 positions has a height")));
  for (const ImageRecord& image : manifest.images) {
    ASSERT_TRUE(image.prior.position_in_enu) << image.name;
    EXPECT_LT(image.prior.position_in_enu->norm(), 200.0) << image.name;
    EXPECT_TRUE(image.prior.heading_deg && image.prior.pitch_deg && image.capture_time_s)
        << image.name;
    EXPECT_EQ(image.drive, 0U);
  }
}

}  // namespace
}  // namespace orbweave
