// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/measure_reconstruction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr size_t kResidualBins = 41;
constexpr size_t kLongestTrack = 20;

/// Distance in the image. Columns are periodic.
double ErpDistance(const EquirectangularCamera& camera,
                   const Eigen::Vector3d& bearing,
                   const Eigen::Vector3d& ray_in_cam) {
  const Eigen::Vector2d apart =
      camera.PixelFromBearing(bearing) - camera.PixelFromBearing(ray_in_cam);
  return std::hypot(std::remainder(apart.x(), static_cast<double>(camera.width_px)), apart.y());
}

}  // namespace

ReconstructionMeter::ReconstructionMeter(const std::map<ImageId, RegisteredImage>& images,
                                         const ImageManifest& manifest)
    : images_(images), manifest_(manifest) {
  measures_.residual_histogram.counts.assign(kResidualBins, 0);
  measures_.track_lengths.assign(kLongestTrack + 1, 0);
  for (const auto& [id, image] : images) measures_.images[id] = {};
}

void ReconstructionMeter::Add(const Track& track) {
  Histogram& histogram = measures_.residual_histogram;
  ++measures_.points;
  ++measures_.track_lengths[std::min(track.observations.size(), kLongestTrack)];
  for (const Observation& observation : track.observations) {
    const ImageId id = observation.ref.image;
    const Eigen::Vector3d ray_in_cam = images_.at(id).cam_from_world * track.point_in_world;
    const double residual_px =
        manifest_.At(id).camera.PixelsFromAngle(AngleBetween(observation.bearing, ray_in_cam));
    const double bin = std::floor(residual_px / histogram.bin_width);
    const bool is_within = bin < kResidualBins - 1.0;  // not so where it is no number
    ++histogram.counts[is_within ? static_cast<size_t>(bin) : kResidualBins - 1];
    sum_px_ += residual_px;
    sum_px2_ += residual_px * residual_px;
    sum_erp_px_ += ErpDistance(manifest_.At(id).camera, observation.bearing, ray_in_cam);
    ++measures_.observations;
    ImageMeasures& of_image = measures_.images[id];
    ++of_image.observations;
    of_image.residual_px_mean += residual_px;
  }
}

ReconstructionMeasures ReconstructionMeter::Finish() && {
  for (auto& [id, image] : measures_.images)
    image.residual_px_mean /= std::max(image.observations, 1U);
  if (measures_.observations == 0) return std::move(measures_);
  const double n = static_cast<double>(measures_.observations);
  measures_.mean_track_length = n / static_cast<double>(measures_.points);
  measures_.residual_px_mean = sum_px_ / n;
  measures_.residual_px_rms = std::sqrt(sum_px2_ / n);
  measures_.residual_erp_px_mean = sum_erp_px_ / n;
  return std::move(measures_);
}

}  // namespace orbweave
