// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/axial_features.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/features/for_each_processor.h"

namespace orbweave {
namespace {

using std::numbers::pi;

constexpr float kTurn = 4.0F;
constexpr float kRounding = 1e-5F;
/// Buckets of a few features: narrower ones would be read no faster.
constexpr size_t kFeaturesPerBucket = 4;

AxialBearing AboutAxis(const Eigen::Vector3d& bearing_in_axial) {
  const auto x = static_cast<float>(bearing_in_axial.x());
  const auto y = static_cast<float>(bearing_in_axial.y());
  const float sin_polar = std::sqrt(x * x + y * y);
  AxialBearing bearing{.cos_polar = static_cast<float>(bearing_in_axial.z()),
                       .sin_polar = sin_polar};
  if (sin_polar > 0.0F) {
    bearing.cos_azimuth = x / sin_polar;
    bearing.sin_azimuth = y / sin_polar;
  }
  return bearing;
}

float AzimuthOf(const AxialBearing& bearing) {
  return PseudoAngle(bearing.cos_azimuth, bearing.sin_azimuth);
}

/// Whether a bearing of b is within a wedge: 1 or 0, without branches.
[[gnu::always_inline]] inline int32_t Test(const AxialBearing& a,
                                           float sin_error,
                                           float min_cos_polar,
                                           const AxialBearing& b) {
  const float sin_polar = a.sin_polar > b.sin_polar ? a.sin_polar : b.sin_polar;
  const float cosine = a.cos_azimuth * b.cos_azimuth + a.sin_azimuth * b.sin_azimuth;
  const float sine = a.sin_azimuth * b.cos_azimuth - a.cos_azimuth * b.sin_azimuth;
  const int32_t at_epipole = sin_polar <= sin_error ? 1 : 0;
  const int32_t same_side = a.cos_polar * b.cos_polar > 0.0F ? 1 : 0;
  const int32_t same_half = cosine > 0.0F ? 1 : 0;
  const int32_t in_plane = sin_polar * std::abs(sine) <= sin_error ? 1 : 0;
  const int32_t reaches = b.cos_polar >= min_cos_polar ? 1 : 0;
  return reaches & ((at_epipole & same_side) | ((1 - at_epipole) & same_half & in_plane));
}

/// Columns of a table of bearings from some row on.
struct BearingColumns {
  const float* cos_azimuth;
  const float* sin_azimuth;
  const float* cos_polar;
  const float* sin_polar;
};

ORBWEAVE_FOR_EACH_PROCESSOR
void TestRows(const AxialBearing& a,
              float sin_error,
              float min_cos_polar,
              const BearingColumns& columns,
              size_t count,
              int32_t* __restrict held) {
  const AxialBearing of_a = a;
  const BearingColumns from = columns;
  for (size_t i = 0; i < count; ++i) {
    held[i] =
        Test(of_a,
             sin_error,
             min_cos_polar,
             {from.cos_azimuth[i], from.sin_azimuth[i], from.cos_polar[i], from.sin_polar[i]});
  }
}

}  // namespace

EpipolarWedge::EpipolarWedge(const AxialBearing& a, double max_error_rad)
    : a_(a), sin_error_(static_cast<float>(std::sin(std::min(max_error_rad, 0.5 * pi)))) {
  const double polar_rad = std::atan2(a.sin_polar, a.cos_polar) + max_error_rad;
  min_cos_polar_ = static_cast<float>(polar_rad < pi ? std::cos(polar_rad) : -2.0);
}

float EpipolarWedge::AzimuthRange() const {
  if (a_.sin_polar <= sin_error_) return kTurn;
  return std::asin(sin_error_ / a_.sin_polar) + kRounding;
}

bool EpipolarWedge::Holds(const AxialBearing& b) const {
  return Test(a_, sin_error_, min_cos_polar_, b) != 0;
}

float PseudoAngle(float x, float y) {
  const float sum = std::abs(x) + std::abs(y);
  if (!(sum > 0.0F)) return 0.0F;
  const float share = y / sum;
  if (x < 0.0F) return 2.0F - share;
  return share >= 0.0F ? share : 4.0F + share;
}

AxialFeatures::AxialFeatures(std::span<const Eigen::Vector3d> bearings,
                             const Eigen::Quaterniond& axial_from_cam) {
  const Eigen::Matrix3d R = axial_from_cam.toRotationMatrix();
  const size_t num_buckets = std::bit_ceil(bearings.size() / kFeaturesPerBucket + 1);
  const float buckets = static_cast<float>(num_buckets) / kTurn;
  std::vector<AxialBearing> axial;
  std::vector<uint32_t> bucket_of;
  axial.reserve(bearings.size());
  bucket_of.reserve(bearings.size());
  first_of_bucket_.assign(num_buckets + 1, 0);
  for (const Eigen::Vector3d& bearing : bearings) {
    axial.push_back(AboutAxis(R * bearing));
    const auto bucket = static_cast<size_t>(AzimuthOf(axial.back()) * buckets);
    bucket_of.push_back(static_cast<uint32_t>(std::min(bucket, num_buckets - 1)));
    ++first_of_bucket_[bucket_of.back() + 1];
  }
  for (size_t k = 0; k < num_buckets; ++k) first_of_bucket_[k + 1] += first_of_bucket_[k];
  for (auto* column : {&cos_azimuth_, &sin_azimuth_, &cos_polar_, &sin_polar_})
    column->resize(axial.size());
  index_.resize(axial.size());
  std::vector<uint32_t> next(first_of_bucket_.begin(), first_of_bucket_.end() - 1);
  for (FeatureIndex i = 0; i < axial.size(); ++i) {
    const uint32_t row = next[bucket_of[i]]++;
    cos_azimuth_[row] = axial[i].cos_azimuth;
    sin_azimuth_[row] = axial[i].sin_azimuth;
    cos_polar_[row] = axial[i].cos_polar;
    sin_polar_[row] = axial[i].sin_polar;
    index_[row] = i;
  }
}

void AxialFeatures::Within(const EpipolarWedge& wedge, std::vector<uint32_t>& rows) const {
  rows.clear();
  const auto num_buckets = static_cast<int>(first_of_bucket_.size()) - 1;
  const float buckets = static_cast<float>(num_buckets) / kTurn;
  const float range = wedge.AzimuthRange();
  if (2.0F * range * buckets >= static_cast<float>(num_buckets - 2))
    return AppendWithin(wedge, 0, num_buckets, rows);
  const float azimuth = AzimuthOf(wedge.a_);
  const int first = static_cast<int>((azimuth - range + kTurn) * buckets) - num_buckets;
  const int last = static_cast<int>((azimuth + range) * buckets);
  AppendWithin(wedge, std::max(first, 0), std::min(last + 1, num_buckets), rows);
  if (first < 0) AppendWithin(wedge, first + num_buckets, num_buckets, rows);
  if (last >= num_buckets) AppendWithin(wedge, 0, last + 1 - num_buckets, rows);
}

void AxialFeatures::AppendWithin(const EpipolarWedge& wedge,
                                 int first_bucket,
                                 int end_bucket,
                                 std::vector<uint32_t>& rows) const {
  constexpr size_t kAtOnce = 256;
  const size_t end = first_of_bucket_[static_cast<size_t>(end_bucket)];
  std::array<int32_t, kAtOnce> held;
  for (size_t row = first_of_bucket_[static_cast<size_t>(first_bucket)]; row < end;
       row += kAtOnce) {
    const size_t count = std::min(kAtOnce, end - row);
    TestRows(wedge.a_,
             wedge.sin_error_,
             wedge.min_cos_polar_,
             {&cos_azimuth_[row], &sin_azimuth_[row], &cos_polar_[row], &sin_polar_[row]},
             count,
             held.data());
    size_t size = rows.size();
    rows.resize(size + count);
    for (size_t i = 0; i < count; ++i) {
      rows[size] = static_cast<uint32_t>(row + i);
      size += static_cast<size_t>(held[i]);
    }
    rows.resize(size);
  }
}

}  // namespace orbweave
