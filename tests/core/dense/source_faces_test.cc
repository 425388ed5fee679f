// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/source_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/dense/reference_raster.h"
#include "core/geometry/cube_face.h"
#include "tests/core/dense/box_world.h"

namespace orbweave {
namespace {

constexpr int kWidth_px = 512;

testing::BoxImage Box() {
  return testing::RenderBox(kWidth_px,
                            Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {0, 0, 0}));
}

double LevelAlong(const Eigen::Vector3d& bearing) {
  return testing::LevelInBox(testing::RangeInBox(Eigen::Vector3d::Zero(), bearing) * bearing);
}

TEST(SourceFaces, ShowWhatLiesInEachDirectionOnEveryFace) {
  const testing::BoxImage image = Box();
  const SourceFaces faces =
      MakeSourceFaces(MakeSourceFaceMap(kWidth_px), MakeGreyPanorama(image.Raster()));
  const auto size = static_cast<size_t>(faces.size_px);
  for (int face = 0; face < kCubeFaces; ++face) {
    double sum = 0.0;
    double count = 0.0;
    for (size_t row = 3; row + 3 < size; row += 5) {
      for (size_t column = 3; column + 3 < size; column += 5) {
        const double middle = 0.5 * (faces.size_px - 1);
        const Eigen::Vector3d in_face((static_cast<double>(column) - middle) / faces.focal_px,
                                      (static_cast<double>(row) - middle) / faces.focal_px,
                                      1.0);
        const Eigen::Vector3d bearing = FaceFromCamera(face).transpose() * in_face.normalized();
        const size_t at = (static_cast<size_t>(face) * size + row) * size + column;
        sum += std::pow((faces.quads[at] & 255) - LevelAlong(bearing), 2.0);
        ++count;
        EXPECT_EQ(faces.quads[at] >> 8 & 255, faces.quads[at + 1] & 255);
        EXPECT_EQ(faces.quads[at] >> 16 & 255, faces.quads[at + size] & 255);
        EXPECT_EQ(faces.quads[at] >> 24, faces.quads[at + size + 1] & 255);
      }
    }
    EXPECT_LT(std::sqrt(sum / count), 2.0) << "face " << face;
  }
  EXPECT_TRUE(faces.ignored.empty());
}

TEST(ReferenceRaster, ShowsWhatLiesInEachDirectionBeyondItsEdges) {
  const ReferenceRaster raster = MakeReferenceRaster(MakeGreyPanorama(Box().Raster()));
  EXPECT_EQ(raster.face_px, kWidth_px / 4);
  const auto stride = static_cast<size_t>(raster.Stride());
  for (size_t face = 0; face < kCubeFaces; ++face) {
    double sum = 0.0;
    double count = 0.0;
    for (size_t row = 0; row < stride; row += 3) {
      for (size_t column = 0; column < stride; column += 3) {
        const Eigen::Vector3d in_face(raster.tangents[column], raster.tangents[row], 1.0);
        const Eigen::Vector3d bearing =
            FaceFromCamera(static_cast<int>(face)).transpose() * in_face.normalized();
        sum += std::pow(raster.levels[face][row * stride + column] - LevelAlong(bearing), 2.0);
        ++count;
      }
    }
    EXPECT_LT(std::sqrt(sum / count), 2.0) << "face " << face;
  }
}

TEST(HalfPanorama, IgnoresWhatHasAnIgnoredPixel) {
  testing::BoxImage image = Box();
  image.ignored.assign(kWidth_px * kWidth_px / 2, 0);
  image.ignored[10 * kWidth_px + 21] = 1;
  const GreyPanorama half = HalfPanorama(MakeGreyPanorama(image.Raster()));
  EXPECT_EQ(half.width_px, kWidth_px / 2);
  EXPECT_EQ(std::ranges::count_if(half.ignored, [](uint8_t mark) { return mark != 0; }), 1);
  EXPECT_NE(half.ignored[5 * kWidth_px / 2 + 10], 0);
}

TEST(GreyPanorama, IsTheSameOfColoursAndOfTheirGreyLevels) {
  Random random(4);
  std::vector<uint8_t> colours(3 * 64 * 32);
  for (uint8_t& level : colours) level = static_cast<uint8_t>(random.Index(256));
  const PanoramaRaster of_colours{
      .width_px = 64, .height_px = 32, .channels = 3, .pixels = colours};
  const std::vector<uint8_t> levels = GreyLevelsOf(of_colours);
  const PanoramaRaster of_levels{.width_px = 64, .height_px = 32, .channels = 1, .pixels = levels};
  EXPECT_EQ(MakeGreyPanorama(of_colours).levels, MakeGreyPanorama(of_levels).levels);
}

TEST(GreyPanorama, GoesOnAcrossSeamAndPoles) {
  const testing::BoxImage image = Box();
  const GreyPanorama grey = MakeGreyPanorama(image.Raster());
  EXPECT_EQ(*grey.At(100, -1), *grey.At(100, kWidth_px - 1));
  EXPECT_EQ(*grey.At(100, kWidth_px + 1), *grey.At(100, 1));
  EXPECT_EQ(*grey.At(-1, 10), *grey.At(0, 10 + kWidth_px / 2));
  EXPECT_EQ(*grey.At(kWidth_px / 2 + 1, 300), *grey.At(kWidth_px / 2 - 2, 300 - kWidth_px / 2));
}

}  // namespace
}  // namespace orbweave
