// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/dense/grey_panorama.h"
#include "core/dense/sample_faces.h"

namespace orbweave {

/// A source panorama as six gnomonic faces (cube_face.h) that overlap, so that a patch about any
/// direction lies wholly on the face nearest to its middle: 5 degrees beyond the edge, and no less
/// than kApron_px. A direction (x, y, z) of a face's frame lies at column
/// focal_px x / z + (size_px - 1) / 2; whole numbers are the middles of pixels. Entry
/// (face * size_px + row) * size_px + column of `quads` holds four grey levels: of that pixel in
/// the lowest byte, then of its right, its lower and its lower right neighbour.
struct SourceFaces {
  static constexpr int kApron_px = 20;
  static constexpr int kTile_px = 4;

  int size_px = 0;
  float focal_px = 0.0F;
  std::vector<uint32_t> quads{};
  int tiles = 0;                   ///< along an edge
  std::vector<uint8_t> ignored{};  ///< 6 x tiles x tiles of kTile_px; empty: nothing is ignored
};

/// The places of source faces in panorama of a width; the focal length is W / 2 pi.
[[nodiscard]] FaceMap MakeSourceFaceMap(int width_px);

[[nodiscard]] SourceFaces MakeSourceFaces(const FaceMap& map, const GreyPanorama& panorama);

}  // namespace orbweave
