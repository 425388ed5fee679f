// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>
#include <cstring>
#include <limits>

#include "core/io/byte_stream.h"
#include "core/io/file.h"
#include "core/io/points/read_ply_points.h"
#include "core/io/points/write_dense_ply.h"
#include "core/io/points/write_las.h"
#include "tests/core/io/io_test_support.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

const Vector3d kOffset(500000.0, 4650000.0, 40.0);

std::vector<SurfacePoint> SomePoints() {
  std::vector<SurfacePoint> points(3);
  points[0].position_in_world = kOffset + Vector3d(1.0005, -2.0, 3.5);
  points[0].normal_in_world = {0.6F, 0.0F, -0.8F};
  points[0].color = {1, 128, 255};
  points[0].sigma_m = 0.0125F;
  points[0].views = 5;
  points[1].position_in_world = kOffset + Vector3d(-700.0, 800.25, 0.0);
  points[2].position_in_world = kOffset + Vector3d(20.0, 30.0, -1.5);
  points[2].views = 255;
  return points;
}

template <typename T>
T At(const std::string& bytes, size_t place) {
  T value{};
  EXPECT_LE(place + sizeof(T), bytes.size());
  std::memcpy(&value, bytes.data() + place, sizeof(T));
  return value;
}

std::string TextAt(const std::string& bytes, size_t place, size_t size) {
  const std::string field = bytes.substr(place, size);
  return field.substr(0, field.find('\0'));
}

std::string WriteLas(const TemporaryFolder& folder, const LasDescription& description) {
  LasWriter writer(folder / "a.las", description);
  const auto points = SomePoints();
  writer.Add({points.data(), 2});
  writer.Add({points.data() + 2, 1});
  EXPECT_TRUE(writer.Finish().ok());
  return ReadFile(folder / "a.las").value();
}

TEST(DensePlyWriter, WritesEveryProperty) {
  const TemporaryFolder folder;
  const auto points = SomePoints();
  DensePlyWriter writer(folder / "a.ply");
  writer.Add({points.data(), 1});
  writer.Add({points.data() + 1, 2});
  ASSERT_TRUE(writer.Finish().ok());
  const auto positions = ReadPlyPoints(folder / "a.ply").value();
  ASSERT_EQ(positions.size(), 3U);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(positions[i], points[i].position_in_world);
  const std::string bytes = ReadFile(folder / "a.ply").value();
  const size_t body = bytes.find("end_header\n") + 11;
  EXPECT_EQ(bytes.size(), body + size_t{3} * 44);
  EXPECT_EQ(At<float>(bytes, body + 24), 0.6F);
  EXPECT_EQ(At<float>(bytes, body + 32), -0.8F);
  EXPECT_EQ(At<uint8_t>(bytes, body + 37), 128);
  EXPECT_EQ(At<float>(bytes, body + 39), 0.0125F);
  EXPECT_EQ(At<uint8_t>(bytes, body + 43), 5);
}

TEST(LasWriter, HasTheHeadOfLas14) {
  const TemporaryFolder folder;
  const std::string wkt = "PROJCS[\"WGS 84 / UTM zone 31N\"]";
  const std::string bytes = WriteLas(folder, {kOffset, wkt, 17, 2026});
  EXPECT_EQ(bytes.substr(0, 4), "LASF");
  EXPECT_EQ(At<uint16_t>(bytes, 4), 0);   // file source
  EXPECT_EQ(At<uint16_t>(bytes, 6), 16);  // global encoding: WKT
  EXPECT_EQ(At<uint8_t>(bytes, 24), 1);
  EXPECT_EQ(At<uint8_t>(bytes, 25), 4);
  EXPECT_EQ(TextAt(bytes, 26, 32), "EXTRACTION");
  EXPECT_EQ(TextAt(bytes, 58, 32), "orbweave");
  EXPECT_EQ(At<uint16_t>(bytes, 90), 17);
  EXPECT_EQ(At<uint16_t>(bytes, 92), 2026);
  EXPECT_EQ(At<uint16_t>(bytes, 94), 375);  // size of the head
  EXPECT_EQ(At<uint32_t>(bytes, 96), 375 + 54 + 5 * 192 + 54 + wkt.size() + 1);
  EXPECT_EQ(At<uint32_t>(bytes, 100), 2U);  // variable length records
  EXPECT_EQ(At<uint8_t>(bytes, 104), 7);    // point data format
  EXPECT_EQ(At<uint16_t>(bytes, 105), 47);
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(At<uint32_t>(bytes, 107 + 4 * i), 0U);  // legacy
  for (size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(At<double>(bytes, 131 + 8 * axis), 0.0005);
    EXPECT_EQ(At<double>(bytes, 155 + 8 * axis), kOffset[static_cast<int>(axis)]);
  }
  const Vector3d high(20.0, 800.25, 3.5);
  const Vector3d low(-700.0, -2.0, -1.5);
  for (int axis = 0; axis < 3; ++axis) {
    const size_t place = 179 + 16 * static_cast<size_t>(axis);
    EXPECT_NEAR(At<double>(bytes, place) - kOffset[axis], high[axis], 1e-6);
    EXPECT_NEAR(At<double>(bytes, place + 8) - kOffset[axis], low[axis], 1e-6);
  }
  EXPECT_EQ(At<uint64_t>(bytes, 227), 0U);  // waveform data
  EXPECT_EQ(At<uint64_t>(bytes, 235), 0U);  // extended records
  EXPECT_EQ(At<uint32_t>(bytes, 243), 0U);
  EXPECT_EQ(At<uint64_t>(bytes, 247), 3U);  // points
  EXPECT_EQ(At<uint64_t>(bytes, 255), 3U);  // of the first return
  for (size_t i = 1; i < 15; ++i) EXPECT_EQ(At<uint64_t>(bytes, 255 + 8 * i), 0U);
}

TEST(LasWriter, DescribesItsExtraBytesAndItsFrame) {
  const TemporaryFolder folder;
  const std::string bytes = WriteLas(folder, {kOffset, "PROJCS[\"x\"]"});
  EXPECT_EQ(TextAt(bytes, 375 + 2, 16), "LASF_Spec");
  EXPECT_EQ(At<uint16_t>(bytes, 375 + 18), 4);
  EXPECT_EQ(At<uint16_t>(bytes, 375 + 20), 5 * 192);
  const std::vector<std::string> names = {"sigma", "NormalX", "NormalY", "NormalZ", "views"};
  const std::vector<int> types = {9, 4, 4, 4, 1};
  for (size_t i = 0; i < 5; ++i) {
    const size_t place = 375 + 54 + 192 * i;
    EXPECT_EQ(At<uint8_t>(bytes, place + 2), types[i]);
    const bool scaled = types[i] == 4;
    EXPECT_EQ(At<uint8_t>(bytes, place + 3), scaled ? 8 : 0);
    EXPECT_EQ(TextAt(bytes, place + 4, 32), names[i]);
    EXPECT_EQ(At<double>(bytes, place + 112), scaled ? 1.0 / 32767.0 : 0.0);
    EXPECT_NE(TextAt(bytes, place + 160, 32), "");
  }
  const size_t frame = 375 + 54 + 5 * 192;
  EXPECT_EQ(TextAt(bytes, frame + 2, 16), "LASF_Projection");
  EXPECT_EQ(At<uint16_t>(bytes, frame + 18), 2112);
  EXPECT_EQ(At<uint16_t>(bytes, frame + 20), 12);
  EXPECT_EQ(bytes.substr(frame + 54, 12), std::string("PROJCS[\"x\"]\0", 12));
}

TEST(LasWriter, StoresPointsInFormatSevenWithExtraBytes) {
  const TemporaryFolder folder;
  const std::string bytes = WriteLas(folder, {kOffset, ""});
  EXPECT_EQ(At<uint32_t>(bytes, 100), 1U);
  const size_t points_at = At<uint32_t>(bytes, 96);
  EXPECT_EQ(points_at, size_t{375} + 54 + 5 * 192);
  EXPECT_EQ(bytes.size(), points_at + size_t{3} * 47);
  const auto points = SomePoints();
  for (size_t i = 0; i < 3; ++i) {
    const size_t place = points_at + 47 * i;
    for (int axis = 0; axis < 3; ++axis) {
      const double stored = At<int32_t>(bytes, place + 4 * static_cast<size_t>(axis)) * 0.0005;
      EXPECT_NEAR(stored + kOffset[axis], points[i].position_in_world[axis], 1e-6);
    }
    EXPECT_EQ(At<uint16_t>(bytes, place + 12), 0);    // intensity
    EXPECT_EQ(At<uint8_t>(bytes, place + 14), 0x11);  // return 1 of 1
    EXPECT_EQ(At<uint8_t>(bytes, place + 15), 0);
    EXPECT_EQ(At<uint8_t>(bytes, place + 16), 0);  // class
    EXPECT_EQ(At<uint8_t>(bytes, place + 17), 0);
    EXPECT_EQ(At<int16_t>(bytes, place + 18), 0);
    EXPECT_EQ(At<uint16_t>(bytes, place + 20), 0);
    EXPECT_EQ(At<double>(bytes, place + 22), 0.0);
    EXPECT_EQ(At<uint16_t>(bytes, place + 30), points[i].color.r * 256);
    EXPECT_EQ(At<uint16_t>(bytes, place + 32), points[i].color.g * 256);
    EXPECT_EQ(At<uint16_t>(bytes, place + 34), points[i].color.b * 256);
    EXPECT_EQ(At<float>(bytes, place + 36), points[i].sigma_m);
    for (int axis = 0; axis < 3; ++axis) {
      const double part = At<int16_t>(bytes, place + 40 + 2 * static_cast<size_t>(axis)) / 32767.0;
      EXPECT_NEAR(part, static_cast<double>(points[i].normal_in_world[axis]), 2e-5);
    }
    EXPECT_EQ(At<uint8_t>(bytes, place + 46), points[i].views);
  }
}

TEST(LasWriter, WritesAnEmptyCloud) {
  const TemporaryFolder folder;
  LasWriter writer(folder / "a.las", {kOffset, ""});
  ASSERT_TRUE(writer.Finish().ok());
  const std::string bytes = ReadFile(folder / "a.las").value();
  EXPECT_EQ(At<uint64_t>(bytes, 247), 0U);
  EXPECT_EQ(At<double>(bytes, 179), 0.0);
  EXPECT_EQ(bytes.size(), At<uint32_t>(bytes, 96));
}

TEST(LasWriter, RefusesWhatDoesNotFit) {
  const TemporaryFolder folder;
  for (const double x : {2e6, std::numeric_limits<double>::quiet_NaN()}) {
    auto points = SomePoints();
    points[1].position_in_world.x() = x + kOffset.x();
    LasWriter writer(folder / "a.las", {kOffset, ""});
    writer.Add(points);
    const absl::Status status = writer.Finish();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_NE(status.message().find("a.las"), std::string::npos);
  }
  const LasDescription too_long = {kOffset, std::string(65535, 'x')};
  EXPECT_EQ(LasWriter(folder / "a.las", too_long).Finish().code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace orbweave
