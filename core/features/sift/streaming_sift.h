// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "core/base/stage_context.h"
#include "core/features/sift/describe_position.h"
#include "core/features/sift/octave_plan.h"
#include "core/features/sift/octave_stream.h"
#include "core/features/sift/sift_kernel.h"
#include "core/features/sift/sift_position.h"
#include "core/features/sift_thresholds.h"
#include "core/scene/features.h"

namespace orbweave {

struct StreamingSiftOptions {
  SiftThresholds thresholds{};
  bool doubled = false;  ///< begin with the octave of the doubled panorama
  double first_y = 0.0;  ///< keypoints' centres lie between these rows, corner convention
  double end_y = 0.0;
  SiftKernel kernel = AvailableSiftKernels().back();
};

/// SIFT of an equirectangular panorama whose rows stream through the octaves: columns continue
/// across the seam, rows across the poles, so neither is a special place. First all positions, then
/// orientations and descriptors of some, for which the rows stream a second time: that costs no
/// more than to write the levels to memory. Lowe, IJCV 2004.
class StreamingSift {
 public:
  /// `panorama`, 8-bit BGR, must outlive this.
  StreamingSift(const cv::Mat& panorama, const StreamingSiftOptions& options);

  /// Finds all positions, row after row within an octave.
  absl::Status Detect(const StageContext& context);

  [[nodiscard]] size_t num_positions() const { return positions_.size(); }
  [[nodiscard]] Keypoint KeypointOf(size_t position) const;  ///< without orientation
  [[nodiscard]] float ResponseOf(size_t position) const { return positions_[position].response; }

  /// Orientations and descriptors of chosen positions, between first_y and end_y, in no order to be
  /// relied on.
  absl::StatusOr<std::vector<internal::DescribedPosition>> Describe(
      std::span<const uint32_t> chosen, const StageContext& context);

 private:
  using Octaves = std::vector<std::unique_ptr<internal::OctaveStream>>;

  [[nodiscard]] Octaves MakeOctaves(
      internal::StreamPurpose purpose,
      const std::function<void(const internal::OctaveStream&)>& after_rows) const;
  absl::Status Stream(const Octaves& octaves, const StageContext& context) const;

  const cv::Mat& panorama_;
  StreamingSiftOptions options_{};
  internal::ScaleSpacePlan plan_{};
  std::vector<internal::SiftPosition> positions_{};
};

}  // namespace orbweave
