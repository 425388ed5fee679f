// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/measure_reconstruction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr size_t kResidualBins = 41;
constexpr size_t kLongestTrack = 20;

}  // namespace

ReconstructionMeasures MeasureReconstruction(const Reconstruction& reconstruction,
                                             const ImageManifest& manifest) {
  ReconstructionMeasures measures;
  measures.points = reconstruction.tracks.size();
  measures.residual_histogram.counts.assign(kResidualBins, 0);
  measures.track_lengths.assign(kLongestTrack + 1, 0);
  for (const auto& [id, image] : reconstruction.images) measures.images[id] = {};
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const Track& track : reconstruction.tracks) {
    ++measures.track_lengths[std::min(track.observations.size(), kLongestTrack)];
    for (const Observation& observation : track.observations) {
      const ImageId id = observation.ref.image;
      const Eigen::Vector3d ray_in_cam =
          reconstruction.images.at(id).cam_from_world * track.point_in_world;
      const double residual_px = AngleBetween(observation.bearing, ray_in_cam) *
                                 manifest.At(id).camera.width_px / (2.0 * std::numbers::pi);
      const double bin = std::floor(residual_px / measures.residual_histogram.bin_width);
      ++measures.residual_histogram.counts[static_cast<size_t>(std::min(bin, kResidualBins - 1.0))];
      sum += residual_px;
      sum_of_squares += residual_px * residual_px;
      ++measures.observations;
      ImageMeasures& of_image = measures.images[id];
      ++of_image.observations;
      of_image.residual_px_mean += residual_px;
    }
  }
  for (auto& [id, image] : measures.images)
    image.residual_px_mean /= std::max(image.observations, 1U);
  if (measures.observations == 0) return measures;
  const double n = static_cast<double>(measures.observations);
  measures.mean_track_length = n / static_cast<double>(measures.points);
  measures.residual_px_mean = sum / n;
  measures.residual_px_rms = std::sqrt(sum_of_squares / n);
  return measures;
}

}  // namespace orbweave
