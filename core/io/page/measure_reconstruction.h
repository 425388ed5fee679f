// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/io/page/job_report.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

struct ImageMeasures {
  uint32_t observations = 0;
  double residual_px_mean = 0.0;
};

/// Numbers of a finished model, recomputed from poses, points and bearings alone. A residual is the
/// angle between bearing and point times W / 2pi; the residual in the equirectangular image itself,
/// which others print, is the distance of their pixels, the seam unwrapped.
struct ReconstructionMeasures {
  uint64_t points = 0;
  uint64_t observations = 0;
  double mean_track_length = 0.0;
  double residual_px_mean = 0.0;
  double residual_px_rms = 0.0;
  double residual_erp_px_mean = 0.0;
  Histogram residual_histogram{};  ///< 40 bins of 0.1 px and one for the rest
  std::vector<uint64_t>
      track_lengths{};  ///< [n]: points seen by n images; the last (20): by 20 or more
  std::map<ImageId, ImageMeasures> images{};
};

/// Measures a model track by track. `images` are all of the model's; both arguments outlive the
/// object.
class ReconstructionMeter {
 public:
  ReconstructionMeter(const std::map<ImageId, RegisteredImage>& images,
                      const ImageManifest& manifest);

  void Add(const Track& track);
  /// Zeros for a model without observations.
  [[nodiscard]] ReconstructionMeasures Finish() &&;

 private:
  const std::map<ImageId, RegisteredImage>& images_;
  const ImageManifest& manifest_;
  double sum_px_ = 0.0;
  double sum_px2_ = 0.0;
  double sum_erp_px_ = 0.0;
  ReconstructionMeasures measures_{};
};

}  // namespace orbweave
