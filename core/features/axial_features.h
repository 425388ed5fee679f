// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
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

/// The sine and cosine of an angular error.
struct AngularError {
  explicit AngularError(double error_rad);

  double sine = 0.0;    ///< of a quarter turn at most
  double cosine = 1.0;  ///< of half a turn at most
};

/// The epipolar half plane of a bearing of a, with room for an error: where some point in front of
/// both spheres that shows as this bearing in a can show in b. That is between the axis (the point
/// at the centre of a) and the bearing of a itself (the point at infinity).
class EpipolarWedge {
 public:
  EpipolarWedge(const AxialBearing& a, const AngularError& max_error);

  /// Half width of its azimuths at most, quarter turns (PseudoAngle): a radian is one at most.
  [[nodiscard]] float AzimuthRange() const;

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
/// plane lie together in memory. Rows are looked at kRowsPerBlock at a time.
class AxialFeatures {
 public:
  static constexpr size_t kRowsPerBlock = 16;

  AxialFeatures(std::span<const Eigen::Vector3d> bearings,
                const Eigen::Quaterniond& axial_from_cam);

  [[nodiscard]] size_t size() const { return index_.size(); }
  [[nodiscard]] AxialBearing At(size_t row) const {
    return {cos_azimuth_[row], sin_azimuth_[row], cos_polar_[row], sin_polar_[row]};
  }
  /// Index of the feature in each row.
  [[nodiscard]] std::span<const FeatureIndex> Indices() const { return index_; }

  /// Blocks of rows [begin, end); the last may be longer than there are rows.
  struct Blocks {
    size_t begin = 0;
    size_t end = 0;
  };
  /// Blocks with all rows within `wedge`, none twice.
  [[nodiscard]] std::array<Blocks, 2> BlocksNear(const EpipolarWedge& wedge) const;

  /// held[i]: 1 where row kRowsPerBlock * blocks.begin + i is within `wedge`, 0 elsewhere, for all
  /// rows of the blocks. The same on every processor.
  void Test(const EpipolarWedge& wedge, const Blocks& blocks, int32_t* held) const;

 private:
  /// Those of the rows of buckets [begin, end).
  [[nodiscard]] Blocks BlocksOf(int first_bucket, int end_bucket) const;

  // Whole blocks; rows beyond the last feature are within no wedge.
  std::vector<float> cos_azimuth_{};
  std::vector<float> sin_azimuth_{};
  std::vector<float> cos_polar_{};
  std::vector<float> sin_polar_{};
  std::vector<FeatureIndex> index_{};
  std::vector<uint32_t> first_of_bucket_{};  ///< one more than there are buckets
};

}  // namespace orbweave
