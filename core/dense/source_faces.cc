// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/source_faces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/cube_face.h"

namespace orbweave {
namespace {

double FocalOf(int width_px) { return width_px / (2.0 * std::numbers::pi); }

void PackFace(const std::vector<uint8_t>& levels, int size_px, uint32_t* quads) {
  const auto size = static_cast<size_t>(size_px);
  for (size_t row = 0; row < size; ++row) {
    const uint8_t* const a = levels.data() + row * size;
    const uint8_t* const b = row + 1 < size ? a + size : a;
    uint32_t* const to = quads + row * size;
    for (size_t k = 0; k + 1 < size; ++k) {
      to[k] = static_cast<uint32_t>(a[k]) | static_cast<uint32_t>(a[k + 1]) << 8 |
              static_cast<uint32_t>(b[k]) << 16 | static_cast<uint32_t>(b[k + 1]) << 24;
    }
    to[size - 1] = to[size - 2];
  }
}

void MarkTiles(const std::vector<uint8_t>& ignored, int size_px, int tiles, uint8_t* marks) {
  const auto size = static_cast<size_t>(size_px);
  for (size_t row = 0; row < size; ++row) {
    uint8_t* const to = marks + row / SourceFaces::kTile_px * static_cast<size_t>(tiles);
    for (size_t k = 0; k < size; ++k) {
      if (ignored[row * size + k] != 0) to[k / SourceFaces::kTile_px] = 1;
    }
  }
}

}  // namespace

FaceMap MakeSourceFaceMap(int width_px) {
  const double focal_px = FocalOf(width_px);
  const double apron_px = (std::tan(50.0 * std::numbers::pi / 180.0) - 1.0) * focal_px;
  const int half =
      static_cast<int>(std::ceil(focal_px + std::max<double>(apron_px, SourceFaces::kApron_px)));
  std::vector<double> tangents;
  for (int k = 0; k < 2 * half; ++k) tangents.push_back((k + 0.5 - half) / focal_px);
  return MakeFaceMap(width_px, width_px / 2, tangents);
}

SourceFaces MakeSourceFaces(const FaceMap& map, const GreyPanorama& panorama) {
  const int size = map.size_px;
  SourceFaces faces{.size_px = size,
                    .focal_px = static_cast<float>(FocalOf(map.width_px)),
                    .tiles = (size + SourceFaces::kTile_px - 1) / SourceFaces::kTile_px};
  const size_t area = static_cast<size_t>(size) * static_cast<size_t>(size);
  const size_t marks = static_cast<size_t>(faces.tiles) * static_cast<size_t>(faces.tiles);
  faces.quads.resize(kCubeFaces * area);
  if (!panorama.ignored.empty()) faces.ignored.resize(kCubeFaces * marks);
  for (int face = 0; face < kCubeFaces; ++face) {
    const auto k = static_cast<size_t>(face);
    PackFace(SampleFace(map, panorama, face), size, faces.quads.data() + k * area);
    if (panorama.ignored.empty()) continue;
    MarkTiles(SampleIgnored(map, panorama, face), size, faces.tiles, &faces.ignored[k * marks]);
  }
  return faces;
}

}  // namespace orbweave
