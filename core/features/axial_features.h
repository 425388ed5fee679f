// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/ids.h"

namespace orbweave {

/// A bearing about the baseline of a pair, which is the z axis of its frame and leads to the centre
/// of the other panorama. All bearings of one epipolar half plane have the same azimuth.
struct AxialBearing {
  float cos_azimuth = 1.0F;
  float sin_azimuth = 0.0F;
  float cos_polar = 1.0F;
  float sin_polar = 0.0F;
};

/// The epipolar half plane of a bearing of a, with room for an error: where some point in front of
/// both spheres that shows as this bearing in a can show in b. That is between the axis (the point
/// at the centre of a) and the bearing of a itself (the point at infinity).
class EpipolarWedge {
 public:
  EpipolarWedge(const AxialBearing& a, double max_error_rad);

  /// Half width of its azimuths, quarter turns (PseudoAngle): a radian is one at most.
  [[nodiscard]] float AzimuthRange() const;

  [[nodiscard]] bool Holds(const AxialBearing& b) const;

 private:
  friend class AxialFeatures;
  AxialBearing a_;
  float sin_error_ = 0.0F;
  float min_cos_polar_ = -1.0F;
};

/// Monotone in atan2(y, x), in quarter turns of [0, 4]: |y| / (|x| + |y|) within the first. It
/// grows by half a quarter turn to one for each radian; (0, 0) has 0.
[[nodiscard]] float PseudoAngle(float x, float y);

/// Features about an axis, ordered by azimuth up to the width of a bucket, so that those near a
/// plane lie together in memory.
class AxialFeatures {
 public:
  AxialFeatures(std::span<const Eigen::Vector3d> bearings,
                const Eigen::Quaterniond& axial_from_cam);

  [[nodiscard]] size_t size() const { return index_.size(); }
  [[nodiscard]] AxialBearing At(size_t row) const {
    return {cos_azimuth_[row], sin_azimuth_[row], cos_polar_[row], sin_polar_[row]};
  }
  /// Index of the feature in this row.
  [[nodiscard]] FeatureIndex IndexOf(size_t row) const { return index_[row]; }

  /// Rows of the features within `wedge`, each once, into `rows`. The same on every processor.
  void Within(const EpipolarWedge& wedge, std::vector<uint32_t>& rows) const;

 private:
  /// Appends those of the rows [begin, end) of buckets.
  void AppendWithin(const EpipolarWedge& wedge,
                    int first_bucket,
                    int end_bucket,
                    std::vector<uint32_t>& rows) const;

  std::vector<float> cos_azimuth_{};
  std::vector<float> sin_azimuth_{};
  std::vector<float> cos_polar_{};
  std::vector<float> sin_polar_{};
  std::vector<FeatureIndex> index_{};
  std::vector<uint32_t> first_of_bucket_{};  ///< one more than there are buckets
};

}  // namespace orbweave
