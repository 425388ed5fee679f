// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/gnss/gnss_table.h"

#include <gmock/gmock.h>

#include "core/base/random.h"
#include "core/io/gnss/gnss_angle.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ParseGnssTable, ReadsColumnsInAnyOrderAndCase) {
  const GnssTable table =
      ParseGnssTable(
          "Longitude,extra,NAME,latitude,Altitude,Accuracy,heading,pitch,roll,drive\n"
          "-122.3,?,a.jpg,47.6,60,0.02,180,1,-2,north\n\n"
          "-122.4,?,b.jpg,47.7,,,,,,\n",
          "gnss.csv")
          .value();
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].name, "a.jpg");
  EXPECT_DOUBLE_EQ(table.rows[0].geodetic->latitude_deg, 47.6);
  EXPECT_DOUBLE_EQ(table.rows[0].geodetic->longitude_deg, -122.3);
  EXPECT_DOUBLE_EQ(table.rows[0].geodetic->altitude_m, 60.0);
  EXPECT_EQ(table.rows[0].accuracy_m, 0.02);
  EXPECT_EQ(table.rows[0].heading_deg, 180.0);
  EXPECT_EQ(table.rows[0].pitch_deg, 1.0);
  EXPECT_EQ(table.rows[0].roll_deg, -2.0);
  EXPECT_EQ(table.rows[0].drive, "north");
  EXPECT_FALSE(table.rows[1].altitude_known);
  EXPECT_FALSE(table.rows[1].accuracy_m);
  EXPECT_EQ(table.rows[1].line, 4);
}

TEST(ParseGnssTable, ReadsExifToolTables) {
  const GnssTable table = ParseGnssTable(
                              "SourceFile,GPSLatitude,GPSLongitude,GPSAltitude,GPSImgDirection,"
                              "DateTimeOriginal,Model,PoseHeadingDegrees\n"
                              "x/R1.JPG,47.61,-122.32,60,90,2016:11:13 11:16:31,THETA,180.0\n"
                              "x/R2.JPG,\"47 deg 36' 36.00\"\" N\",\"122 deg 19' 12.00\"\" W\",60 "
                              "m Above Sea Level,90,,THETA,\n",
                              "exif.csv")
                              .value();
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].heading_deg, 180.0);
  EXPECT_EQ(table.rows[0].capture_time_s, 1479035791.0);
  EXPECT_NEAR(table.rows[1].geodetic->latitude_deg, 47.61, 1e-12);
  EXPECT_NEAR(table.rows[1].geodetic->longitude_deg, -122.32, 1e-12);
  EXPECT_DOUBLE_EQ(table.rows[1].geodetic->altitude_m, 60.0);
}

TEST(ParseGnssTable, ReadsLocalMetres) {
  const GnssTable table = ParseGnssTable("name;x;y;z\na.jpg;1.5;-2;3\n", "local.csv").value();
  EXPECT_EQ(*table.rows[0].position_in_local, Eigen::Vector3d(1.5, -2.0, 3.0));
  EXPECT_FALSE(table.rows[0].geodetic);
}

TEST(ParseGnssTable, ReadsPosTxtInMetresAndDegrees) {
  const GnssTable metres = ParseGnssTable(
                               "#F=N X Y Z R\n# comment\nT_1.jpg 182.08 536.96 5.53 1 0 0 0 1 0 0 "
                               "0 1\nT_2.jpg 185.0 539.1 5.6 1 0 0 0 1 0 0 0 1\n",
                               "POS.txt")
                               .value();
  ASSERT_EQ(metres.rows.size(), 2U);
  EXPECT_EQ(*metres.rows[0].position_in_local, Eigen::Vector3d(182.08, 536.96, 5.53));
  const GnssTable degrees =
      ParseGnssTable("#F=N Y X Z K W P\nT_1.jpg,30.51,114.41,20.5,0,0,0\n", "POS.txt").value();
  EXPECT_DOUBLE_EQ(degrees.rows[0].geodetic->latitude_deg, 30.51);
  EXPECT_DOUBLE_EQ(degrees.rows[0].geodetic->longitude_deg, 114.41);
  EXPECT_DOUBLE_EQ(degrees.rows[0].geodetic->altitude_m, 20.5);
}

TEST(ParseGnssTable, RejectsAbsurdRowsWithLineAndReason) {
  const GnssTable table =
      ParseGnssTable(
          "name,latitude,longitude\n"
          "good.jpg,47.6,-122.3\ngood2.jpg,47.6,-122.3\ngood3.jpg,47.6,-122.3\n"
          "zero.jpg,0,0\nnan.jpg,nan,3\nword.jpg,north,3\nfar.jpg,12,-200\nnone.jpg,,\nshort.jpg\n,"
          "1,2\ngood.jpg,47.5,-122.3\nhigh.jpg,91,-122\n",
          "gnss.csv")
          .value();
  EXPECT_EQ(table.rows.size(), 3U);
  ASSERT_EQ(table.rejected.size(), 9U);
  EXPECT_EQ(table.rejected[0].name, "gnss.csv line 5 (zero.jpg)");
  EXPECT_THAT(table.rejected[0].reason, HasSubstr("0/0"));
  EXPECT_THAT(table.rejected[1].reason, HasSubstr("not a number"));
  EXPECT_THAT(table.rejected[2].reason, HasSubstr("'north' is not a number"));
  EXPECT_THAT(table.rejected[3].reason, HasSubstr("beyond 180"));
  EXPECT_THAT(table.rejected[4].reason, HasSubstr("no position"));
  EXPECT_THAT(table.rejected[5].reason, HasSubstr("no position"));
  EXPECT_THAT(table.rejected[6].reason, HasSubstr("names no image"));
  EXPECT_THAT(table.rejected[7].reason, HasSubstr("repeats line 2"));
  EXPECT_THAT(table.rejected[8].reason, HasSubstr("beyond 90"));
}

TEST(ParseGnssTable, SeesSwappedLatitudeAndLongitude) {
  const absl::Status status =
      ParseGnssTable("name,latitude,longitude\na.jpg,139.7,35.6\nb.jpg,139.8,35.7\n", "tokyo.csv")
          .status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(status.message(),
              HasSubstr("tokyo.csv: latitude and longitude look swapped (line 2"));
  EXPECT_THAT(status.message(), HasSubstr("exchange the two columns"));
}

TEST(ParseGnssTable, NamesWhatIsMissing) {
  EXPECT_THAT(ParseGnssTable("", "g.csv").status().message(),
              HasSubstr("g.csv: the table is empty"));
  EXPECT_THAT(ParseGnssTable("a.jpg,47.6,-122.3,60\n", "g.csv").status().message(),
              HasSubstr("must name the columns"));
  EXPECT_THAT(ParseGnssTable("name,latitude\na,1\n", "g.csv").status().message(),
              HasSubstr("must name the columns"));
  EXPECT_THAT(ParseGnssTable("#F=N X Y\na 1 2\n", "POS.txt").status().message(),
              HasSubstr("must name N, X, Y and Z"));
  EXPECT_THAT(ParseGnssTable("name,latitude,longitude\na,0,0\n", "g.csv").status().message(),
              HasSubstr("no row gives a position; g.csv line 2 (a): its position is 0/0"));
}

TEST(ParseGnssTable, ReadsAccuraciesFixTypesAndTimes) {
  const GnssTable table =
      ParseGnssTable(
          "name,lat,lon,alt,accuracy,vertical_accuracy,fix_type,time,heading,heading_accuracy,"
          "pitch,pitch_accuracy,roll,roll_accuracy\n"
          "a.jpg,47.6,8.5,400,0.02,0.05,RTK fixed,2024-05-01T10:00:00.5Z,90,0.2,1,0.1,2,0.3\n"
          "b.jpg,47.6,8.5,400,,,float,1714557601.25,,,,,,\n"
          "c.jpg,47.6,8.5,400,0,-1,2,1714557602250,,,,,,\n",
          "gnss.csv")
          .value();
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0].accuracy_m, 0.02);
  EXPECT_EQ(table.rows[0].vertical_accuracy_m, 0.05);
  EXPECT_EQ(table.rows[0].fix, GnssFix::kRtkFixed);
  EXPECT_EQ(table.rows[0].capture_time_s, 1714557600.5);
  EXPECT_EQ(table.rows[0].heading_sigma_deg, 0.2);
  EXPECT_EQ(table.rows[0].tilt_sigma_deg, 0.3);
  EXPECT_EQ(table.rows[1].fix, GnssFix::kRtkFloat);
  EXPECT_EQ(table.rows[1].capture_time_s, 1714557601.25);
  EXPECT_FALSE(table.rows[1].accuracy_m || table.rows[1].heading_sigma_deg ||
               table.rows[1].tilt_sigma_deg);
  EXPECT_EQ(table.rows[2].fix, GnssFix::kDifferential);
  EXPECT_EQ(table.rows[2].capture_time_s, 1714557602.25);  // milliseconds
  EXPECT_FALSE(table.rows[2].accuracy_m || table.rows[2].vertical_accuracy_m);
  EXPECT_THAT(table.warnings, IsEmpty());
}

TEST(ParseGnssTable, DropsPositionsWithoutAFixAndSaysSo) {
  const GnssTable table = ParseGnssTable(
                              "name,latitude,longitude,fix,heading\na.jpg,47.6,8.5,4,\n"
                              "b.jpg,47.7,8.5,none,90\nc.jpg,,,No Fix,\nd.jpg,47.6,8.5,6,\n",
                              "gnss.csv")
                              .value();
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_TRUE(table.rows[0].geodetic);
  for (size_t i = 1; i < 4; ++i) EXPECT_FALSE(table.rows[i].geodetic) << i;
  EXPECT_EQ(table.rows[1].heading_deg, 90.0);
  EXPECT_THAT(table.rejected, IsEmpty());
  EXPECT_THAT(table.warnings,
              ElementsAre("3 rows of gnss.csv have no fix: its position is not used: line 3 "
                          "('none'), line 4 ('No Fix'), line 5 ('6')"));
  EXPECT_THAT(
      ParseGnssTable("name,latitude,longitude,fix\na.jpg,47.6,8.5,0\n", "g.csv").status().message(),
      HasSubstr("no row gives a position; 1 row of g.csv has no fix"));
}

TEST(ParseGnssTable, LeavesOutCellsThatCannotBeAndCountsThem) {
  const GnssTable table = ParseGnssTable(
                              "name,latitude,longitude,altitude,accuracy,pitch,heading,fix,time\n"
                              "a.jpg,47.6,8.5,1e308,1e-300,91,9999,perhaps,yesterday\n"
                              "b.jpg,47.6,8.5,-9999,1e300,-1,-90,,\n"
                              "c.jpg,47.6,8.5,12.5 m Below Sea Level,,,,,\n",
                              "gnss.csv")
                              .value();
  ASSERT_EQ(table.rows.size(), 3U);
  for (size_t i = 0; i < 2; ++i)
    EXPECT_FALSE(table.rows[i].altitude_known || table.rows[i].accuracy_m) << i;
  EXPECT_TRUE(table.rows[0].geodetic);
  EXPECT_FALSE(table.rows[1].geodetic);  // worse than 10 km
  EXPECT_FALSE(table.rows[0].pitch_deg || table.rows[0].heading_deg || table.rows[0].fix ||
               table.rows[0].capture_time_s);
  EXPECT_EQ(table.rows[1].pitch_deg, -1.0);
  EXPECT_EQ(table.rows[1].heading_deg, -90.0);
  EXPECT_EQ(table.rows[2].geodetic->altitude_m, -12.5);
  EXPECT_THAT(
      table.warnings,
      ElementsAre("1 row of gnss.csv has a fix type that nobody knows: line 2 ('perhaps')",
                  "2 rows of gnss.csv have a heading, pitch or roll that cannot be and is not "
                  "used: line 2 ('9999'), line 2 ('91')",
                  "1 row of gnss.csv has a time that cannot be read: line 2 ('yesterday')",
                  "1 row of gnss.csv has an accuracy beyond 10 km: its position is not used: line "
                  "3 ('1e300')",
                  "1 row of gnss.csv has an accuracy that cannot be and is not used: line 2 "
                  "('1e-300')",
                  "2 rows of gnss.csv have an altitude that cannot be and is not used: line 2 "
                  "('1e308'), line 3 ('-9999')"));
}

TEST(ParseGnssTable, RefusesDecimalCommas) {
  for (const char* text : {"name;latitude;longitude\na.jpg;47,61;-122,32\n",
                           "name,latitude,longitude\na.jpg,\"47,61\",\"-122,32\"\n",
                           "name;latitude;longitude;accuracy\na.jpg;47.61;-122.32;0,05\n",
                           "name x y z\na.jpg 12,5 7,25 3,0\n",
                           "name latitude longitude\na.jpg 47,61 -122,32\n",
                           "#F=N X Y Z\na.jpg 12,5 7,25 3,0\n"}) {
    const absl::Status status = ParseGnssTable(text, "g.csv").status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << text;
    EXPECT_THAT(status.message(), HasSubstr("g.csv line 2: the number '")) << text;
    EXPECT_THAT(status.message(), HasSubstr("has a decimal comma")) << text;
  }
}

TEST(ParseGnssTable, TakesCommasAndBlanksBetweenWords) {
  for (const char* text :
       {"#F=N X Y Z\na.jpg, 1200, 725.5, 3\n", "#F=N X Y Z\na.jpg,1200,725.5,3\n"}) {
    const auto table = ParseGnssTable(text, "POS.txt");
    ASSERT_TRUE(table.ok()) << table.status();
    ASSERT_EQ(table->rows.size(), 1U);
    EXPECT_EQ(table->rows[0].position_in_local, Eigen::Vector3d(1200.0, 725.5, 3.0)) << text;
  }
}

TEST(ParseGnssTable, RejectsRowsOfMoreCellsThanTheHeaderNames) {
  // Between commas, 47,61 is two cells: latitude 47 and longitude 61.
  const absl::Status status =
      ParseGnssTable("name,latitude,longitude\na.jpg,47,61,-122,32\n", "g.csv").status();
  EXPECT_THAT(status.message(), HasSubstr("it has 5 cells where the header names 3"));
  EXPECT_TRUE(ParseGnssTable("name,latitude,longitude\na.jpg,47.61,-122.32,,\n", "g.csv").ok());
}

TEST(GnssAngle, ReadsDegreesMinutesAndSeconds) {
  for (const char* text : {"47 deg 36' 36.00\" N",
                           "47\xc2\xb0"
                           "36'36.0\"N",
                           "47d36m36s N",
                           "47:36:36 N",
                           "47 36.6 N",
                           "47.61 N",
                           " 47.61 "}) {
    const std::optional<double> angle = GnssAngle(text, "NS");
    ASSERT_TRUE(angle) << text;
    EXPECT_NEAR(*angle, 47.61, 1e-12) << text;
  }
  EXPECT_EQ(GnssAngle("122 30 0 W", "EW"), -122.5);
  EXPECT_EQ(GnssAngle("-122.5", "EW"), -122.5);
}

TEST(GnssAngle, RefusesWhatContradictsItself) {
  for (const char* text : {"-47 30 0 N",
                           "-47.5 S",
                           "47 30 0 E",
                           "47 61 0 N",
                           "47 30 61 N",
                           "47.5 30 0 N",
                           "47 30 0",
                           "47 30 0 0 N",
                           "N",
                           "1e2 N",
                           "",
                           "north"}) {
    EXPECT_FALSE(GnssAngle(text, "NS")) << text;
  }
}

TEST(GnssFix, IsKnownByWordsAndByNumbersOfNmea) {
  EXPECT_EQ(GnssFixFromText("RTK_FIXED"), GnssFix::kRtkFixed);
  EXPECT_EQ(GnssFixFromText("rtk-float"), GnssFix::kRtkFloat);
  EXPECT_EQ(GnssFixFromText("5"), GnssFix::kRtkFloat);
  EXPECT_EQ(GnssFixFromText("SBAS"), GnssFix::kDifferential);
  EXPECT_EQ(GnssFixFromText("1"), GnssFix::kAutonomous);
  EXPECT_EQ(GnssFixFromText("dead reckoning"), GnssFix::kNone);
  EXPECT_FALSE(GnssFixFromText("9"));
  EXPECT_FALSE(GnssFixFromText(""));
  EXPECT_LT(SigmaOfFix(GnssFix::kRtkFixed), SigmaOfFix(GnssFix::kRtkFloat));
  EXPECT_LT(SigmaOfFix(GnssFix::kRtkFloat), SigmaOfFix(GnssFix::kDifferential));
  EXPECT_FALSE(SigmaOfFix(GnssFix::kAutonomous));
}

TEST(ParseGnssTable, SurvivesAnyText) {
  const std::string intact =
      "name,latitude,longitude,altitude\r\n\"a,b.jpg\",47.6,-122.3,60\r\nb.jpg,47.7,-122.4,61\r\n";
  const size_t first_longitude = intact.find("-1") + 2;
  for (size_t size = 0; size < intact.size(); ++size) {
    EXPECT_EQ(ParseGnssTable(intact.substr(0, size), "g.csv").ok(), size >= first_longitude)
        << size;
  }
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = intact;
    for (int i = 0; i < 5; ++i)
      damaged[random.Index(static_cast<uint32_t>(damaged.size()))] =
          static_cast<char>(random.Index(256));
    const absl::StatusOr<GnssTable> table = ParseGnssTable(damaged, "g.csv");
    if (!table.ok()) continue;
    for (const GnssRow& row : table->rows)
      EXPECT_TRUE(row.geodetic.has_value() || row.position_in_local.has_value());
  }
}

}  // namespace
}  // namespace orbweave
