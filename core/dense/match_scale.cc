// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/match_scale.h"

namespace orbweave {
namespace {

MatchView ViewOf(const SourceFaces& faces, const Rigid3& source_from_reference, int face) {
  MatchView view{.quads = faces.quads.data(),
                 .size_px = faces.size_px,
                 .focal_px = faces.focal_px,
                 .ignored = faces.ignored.empty() ? nullptr : faces.ignored.data(),
                 .tiles = faces.tiles};
  const Eigen::Matrix3d R =
      source_from_reference.rotation.toRotationMatrix() * FaceFromCamera(face).transpose();
  for (int k = 0; k < 9; ++k)
    view.rotation[static_cast<size_t>(k)] = static_cast<float>(R(k / 3, k % 3));
  for (int k = 0; k < 3; ++k)
    view.translation[static_cast<size_t>(k)] =
        static_cast<float>(source_from_reference.translation[k]);
  return view;
}

/// Where the mean of a patch's taps lies, for their tangents are no linear function of the pixel:
/// half the second derivative, x (1 + x^2) per squared radian, times the mean of 1, 9 and 25
/// pixels.
float MiddleOfTaps(const ReferenceRaster& raster, size_t at) {
  constexpr float kMeanSquare_px = 35.0F / 3.0F;
  const float x = raster.tangents[at];
  const float step = raster.tangent_steps[at];
  return x + kMeanSquare_px * x * step * step / (1.0F + x * x);
}

}  // namespace

MatchScale::MatchScale(const GreyPanorama& reference,
                       std::span<const GreyPanorama> source_panoramas,
                       std::span<const Rigid3> sources_from_reference,
                       int halvings)
    : times_halved(halvings), raster(MakeReferenceRaster(reference)) {
  const FaceMap map = MakeSourceFaceMap(reference.width_px);
  for (const GreyPanorama& source : source_panoramas)
    sources.push_back(MakeSourceFaces(map, source));
  views.resize(sources.size());
  centres.resize(sources.size());
  for (size_t k = 0; k < sources.size(); ++k) {
    const Eigen::Vector3d centre = sources_from_reference[k].Centre();
    for (int face = 0; face < kCubeFaces; ++face) {
      const auto f = static_cast<size_t>(face);
      views[k][f] = ViewOf(sources[k], sources_from_reference[k], face);
      centres[k][f] = (FaceFromCamera(face) * centre).cast<float>();
    }
  }
}

void PreparePatches(const MatchScale& scale, const MatchPlace& place, ReferencePatches& patches) {
  const ReferenceRaster& raster = scale.raster;
  const std::vector<uint8_t>& levels = raster.levels[static_cast<size_t>(place.face)];
  const auto row = static_cast<size_t>(place.row);
  const auto column = static_cast<size_t>(place.column);
  PreparePatches(
      &levels[row * static_cast<size_t>(raster.Stride()) + column], raster.Stride(), patches);
  patches.y = MiddleOfTaps(raster, row);
  patches.dy = raster.tangent_steps[row];
  for (size_t k = 0; k < kMatchLanes; ++k) {
    patches.x[k] = MiddleOfTaps(raster, column + 2 * k);
    patches.dx[k] = raster.tangent_steps[column + 2 * k];
  }
}

}  // namespace orbweave
