// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/dense/grey_panorama.h"

namespace orbweave {

/// Where the pixels of cube faces lie in panoramas of one size. Pixel (row, column) of a face looks
/// along (tangents[column], tangents[row], 1) in the face's frame (cube_face.h); positions are in
/// 1/32 px from the middle of the panorama's first pixel.
struct FaceMap {
  int size_px = 0;
  int width_px = 0;
  int height_px = 0;
  std::vector<int32_t> side_columns{};   ///< by column, of the front face; the others a quarter on
  std::vector<int32_t> side_rows{};      ///< size_px x size_px, all four side faces
  std::vector<int32_t> upper_columns{};  ///< size_px x size_px
  std::vector<int32_t> upper_rows{};     ///< the lower face mirrors the upper one
};

/// `tangents`: as many as a face has rows and columns, antisymmetric about their middle.
[[nodiscard]] FaceMap MakeFaceMap(int width_px, int height_px, std::span<const double> tangents);

/// Grey levels of one face, row-major, by cubic convolution (Keys 1981, a = -1/2) in integers.
[[nodiscard]] std::vector<uint8_t> SampleFace(const FaceMap& map,
                                              const GreyPanorama& panorama,
                                              int face);

/// What is not 0 at the nearest pixel is ignored; empty when the panorama ignores nothing.
[[nodiscard]] std::vector<uint8_t> SampleIgnored(const FaceMap& map,
                                                 const GreyPanorama& panorama,
                                                 int face);

}  // namespace orbweave
