// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/plane_field.h"

#include <gtest/gtest.h>

#include <set>

#include "core/dense/equiangular_raster.h"

namespace orbweave {
namespace {

constexpr int kFace_px = 16;
constexpr int kApron = PlaneField::kApron_px;

TEST(PlaneField, HasAPlaceOfItsOwnForEachPixel) {
  const PlaneField field(kFace_px);
  std::set<size_t> places;
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = 0; row < kFace_px + 2 * kApron; ++row) {
      for (int column = 0; column < kFace_px + 2 * kApron; ++column)
        places.insert(field.AtPixel(face, row, column));
    }
  }
  const size_t edge = kFace_px + 2 * kApron;
  EXPECT_EQ(places.size(), 6 * edge * edge);
  EXPECT_LT(*places.rbegin(), field.cost.size());
}

TEST(PlaneField, GoesOnBeyondItsEdgesWithThePlanesOfOtherFaces) {
  // One plane in the camera frame, as each face sees it.
  const Eigen::Vector3f q(0.1F, 0.3F, -0.2F);
  PlaneField field(kFace_px);
  for (int face = 0; face < kCubeFaces; ++face) {
    const Eigen::Vector3f in_face = FaceFromCamera(face).cast<float>() * q;
    for (int row = kApron; row < kApron + kFace_px; ++row) {
      for (int column = kApron; column < kApron + kFace_px; ++column) {
        const size_t at = field.AtPixel(face, row, column);
        field.x[at] = in_face.x();
        field.y[at] = in_face.y();
        field.z[at] = in_face.z();
        field.cost[at] = static_cast<float>(face);
      }
    }
  }
  field.FillAprons();
  for (int face = 0; face < kCubeFaces; ++face) {
    const Eigen::Vector3f in_face = FaceFromCamera(face).cast<float>() * q;
    for (const int row : {0, 5, kApron + 3, kApron + kFace_px + 4}) {
      const size_t at = field.AtPixel(face, row, 2);
      EXPECT_EQ(Eigen::Vector3f(field.x[at], field.y[at], field.z[at]), in_face);
      EXPECT_NE(field.cost[at], static_cast<float>(face));
    }
  }
}

}  // namespace
}  // namespace orbweave
