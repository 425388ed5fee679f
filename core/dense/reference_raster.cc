// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/reference_raster.h"

#include <cmath>
#include <numbers>

#include "core/dense/sample_faces.h"

namespace orbweave {
namespace {

constexpr size_t kOverrun_px = 64;

}  // namespace

ReferenceRaster MakeReferenceRaster(const GreyPanorama& panorama) {
  ReferenceRaster raster{.face_px = panorama.width_px / 4};
  const double pixel_rad = 0.5 * std::numbers::pi / raster.face_px;
  std::vector<double> tangents;
  for (int k = 0; k < raster.Stride(); ++k) {
    const double from_middle = k - ReferenceRaster::kApron_px + 0.5 - 0.5 * raster.face_px;
    const double tangent = std::tan(from_middle * pixel_rad);
    tangents.push_back(tangent);
    raster.tangents.push_back(static_cast<float>(tangent));
    raster.tangent_steps.push_back(static_cast<float>((1.0 + tangent * tangent) * pixel_rad));
  }
  // Lanes may run over the end of a row.
  raster.tangents.resize(raster.tangents.size() + kOverrun_px, raster.tangents.back());
  raster.tangent_steps.resize(raster.tangents.size(), raster.tangent_steps.back());
  const FaceMap map = MakeFaceMap(panorama.width_px, panorama.height_px, tangents);
  for (int face = 0; face < kCubeFaces; ++face) {
    std::vector<uint8_t>& levels = raster.levels[static_cast<size_t>(face)];
    levels = SampleFace(map, panorama, face);
    levels.resize(levels.size() + kOverrun_px);
    raster.ignored[static_cast<size_t>(face)] = SampleIgnored(map, panorama, face);
  }
  return raster;
}

}  // namespace orbweave
