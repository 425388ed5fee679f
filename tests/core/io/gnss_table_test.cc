// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/gnss_table.h"

#include <gmock/gmock.h>

#include "core/base/random.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

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
