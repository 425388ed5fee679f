// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/points/read_ply_points.h"

#include "absl/strings/str_cat.h"
#include "core/io/byte_stream.h"
#include "core/io/points/write_ply.h"
#include "tests/core/io/io_test_support.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

std::string Header(const std::string& format, const std::string& rest) {
  return "ply\nformat " + format + " 1.0\ncomment x y z\n" + rest + "end_header\n";
}

void ExpectRefused(const std::string& bytes, const std::string& reason) {
  const auto points = PlyPointsFromBytes(bytes, "some/cloud.ply");
  ASSERT_FALSE(points.ok()) << reason;
  EXPECT_EQ(points.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(points.status().message().find("some/cloud.ply"), std::string::npos);
  EXPECT_NE(points.status().message().find(reason), std::string::npos) << points.status();
}

TEST(ReadPlyPoints, GivesBackWhatPlyWriterWrote) {
  const TemporaryFolder folder;
  PlyWriter writer(folder / "a.ply");
  const std::vector<Vector3d> truth = {{1.25, -2.0, 1e6 + 0.125}, {0.0, 1e-300, 3.0}};
  for (const Vector3d& point : truth) writer.Add({.point_in_world = point});
  ASSERT_TRUE(writer.Finish().ok());
  EXPECT_EQ(ReadPlyPoints(folder / "a.ply").value(), truth);
}

TEST(ReadPlyPoints, SkipsOtherPropertiesListsAndElements) {
  const std::string header = Header("binary_little_endian",
                                    "element camera 1\nproperty short id\n"
                                    "element vertex 2\nproperty uchar red\nproperty float32 z\n"
                                    "property list uchar int ids\nproperty float y\n"
                                    "property double x\nelement face 7\nproperty int a\n");
  ByteWriter body;
  body.Put<int16_t>(9);
  for (int i = 0; i < 2; ++i) {
    body.Put<uint8_t>(200).Put(3.5F).Put<uint8_t>(2).Put(-1).Put(-2).Put(2.5F).Put(1.0 + i);
  }
  const auto points = PlyPointsFromBytes(header + body.Take(), "a").value();
  EXPECT_EQ(points, (std::vector<Vector3d>{{1.0, 2.5, 3.5}, {2.0, 2.5, 3.5}}));
}

TEST(ReadPlyPoints, ReadsTextWithAnyLineEnds) {
  const std::string header =
      Header("ascii", "element vertex 2\nproperty float x\nproperty float y\nproperty double z\n");
  const std::vector<Vector3d> truth = {{1.5, -2.0, 3e2}, {4.0, 5.0, 6.0}};
  EXPECT_EQ(PlyPointsFromBytes(header + "1.5 -2 3e2\n4 5 6\n", "a").value(), truth);
  EXPECT_EQ(PlyPointsFromBytes(header + "1.5 -2 3e2\r\n4 5 6", "a").value(), truth);
}

TEST(ReadPlyPoints, TakesNoPointsForAnAnswer) {
  const std::string none =
      Header("ascii", "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n");
  EXPECT_TRUE(PlyPointsFromBytes(none, "a").value().empty());
}

TEST(ReadPlyPoints, SaysWhatIsWrongAndWithWhichFile) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  ExpectRefused("", "does not begin");
  ExpectRefused("pliant\n", "does not begin");
  ExpectRefused("ply\nformat ascii 1.0\n", "no end");
  ExpectRefused("ply\nelement vertex 0\n" + xyz + "end_header\n", "no format");
  ExpectRefused(Header("binary_big_endian", ""), "binary_big_endian");
  ExpectRefused(Header("ascii", "element face 0\nproperty int a\n"), "no element 'vertex'");
  ExpectRefused(Header("ascii", "element vertex 1\nproperty float x\n") + "1\n", "lack x, y or z");
  ExpectRefused(Header("ascii", "element vertex many\n" + xyz), "element vertex many");
  ExpectRefused(Header("ascii", "element vertex 1\nproperty quad x\n"), "property quad x");
  ExpectRefused(Header("ascii", "element vertex 2\n" + xyz) + "1 2 3\n4 5\n", "vertex 2 of 2");
  ExpectRefused(Header("ascii", "element vertex 1\n" + xyz) + "1 two 3\n", "vertex 1 of 1");
  ExpectRefused(Header("binary_little_endian", "element vertex 99999999999\n" + xyz) + "123",
                "vertex 1 of 99999999999");
  EXPECT_EQ(ReadPlyPoints("/nowhere/a.ply").status().code(), absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace orbweave
