// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/axial_features.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/base/for_each_processor.h"

namespace orbweave {
namespace {

using std::numbers::pi;

constexpr float kTurn = 4.0F;
constexpr float kRounding = 1e-5F;
/// Of a row without a feature: no wedge reaches there.
constexpr float kNowhere = -4.0F;
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

AngularError::AngularError(double error_rad)
    : sine(std::sin(std::min(error_rad, 0.5 * pi))), cosine(std::cos(std::min(error_rad, pi))) {}

EpipolarWedge::EpipolarWedge(const AxialBearing& a, const AngularError& max_error)
    : a_(a), sin_error_(static_cast<float>(max_error.sine)) {
  // cos(polar + error), of the one coordinate of the two that is exact near either end of the axis.
  const double sin_polar = a.sin_polar;
  const double cos_polar = std::copysign(std::sqrt(std::max(0.0, 1.0 - sin_polar * sin_polar)),
                                         static_cast<double>(a.cos_polar));
  const bool ends_before_axis = sin_polar * max_error.cosine + cos_polar * max_error.sine > 0.0;
  min_cos_polar_ =
      ends_before_axis
          ? static_cast<float>(cos_polar * max_error.cosine - sin_polar * max_error.sine)
          : -2.0F;
}

float EpipolarWedge::AzimuthRange() const {
  if (a_.sin_polar <= sin_error_) return kTurn;
  // asin(s) = s + s^3 / 6 + ..., whose further coefficients sum up to pi / 2 - 1.
  constexpr float kRest = 0.5708F;
  const float sine = sin_error_ / a_.sin_polar;
  return sine * (1.0F + kRest * sine * sine) + kRounding;
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
  const size_t num_rows = (axial.size() + kRowsPerBlock - 1) / kRowsPerBlock * kRowsPerBlock;
  for (auto* column : {&cos_azimuth_, &sin_azimuth_, &cos_polar_, &sin_polar_})
    column->resize(num_rows, kNowhere);
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

std::array<AxialFeatures::Blocks, 2> AxialFeatures::BlocksNear(const EpipolarWedge& wedge) const {
  const auto num_buckets = static_cast<int>(first_of_bucket_.size()) - 1;
  const float buckets = static_cast<float>(num_buckets) / kTurn;
  const float range = wedge.AzimuthRange();
  const Blocks all = BlocksOf(0, num_buckets);
  if (2.0F * range * buckets >= static_cast<float>(num_buckets - 2)) return {all, Blocks{}};
  const float azimuth = AzimuthOf(wedge.a_);
  const int first = static_cast<int>((azimuth - range + kTurn) * buckets) - num_buckets;
  const int last = static_cast<int>((azimuth + range) * buckets);
  const Blocks within = BlocksOf(std::max(first, 0), std::min(last + 1, num_buckets));
  Blocks beyond;
  if (first < 0) beyond = BlocksOf(first + num_buckets, num_buckets);
  if (last >= num_buckets) beyond = BlocksOf(0, last + 1 - num_buckets);
  const bool are_apart = beyond.end <= within.begin || within.end <= beyond.begin;
  if (!are_apart) return {all, Blocks{}};
  return {within, beyond};
}

AxialFeatures::Blocks AxialFeatures::BlocksOf(int first_bucket, int end_bucket) const {
  const size_t begin = first_of_bucket_[static_cast<size_t>(first_bucket)];
  const size_t end = first_of_bucket_[static_cast<size_t>(end_bucket)];
  if (begin == end) return {};
  return {begin / kRowsPerBlock, (end + kRowsPerBlock - 1) / kRowsPerBlock};
}

void AxialFeatures::Test(const EpipolarWedge& wedge, const Blocks& blocks, int32_t* held) const {
  const size_t row = blocks.begin * kRowsPerBlock;
  TestRows(wedge.a_,
           wedge.sin_error_,
           wedge.min_cos_polar_,
           {&cos_azimuth_[row], &sin_azimuth_[row], &cos_polar_[row], &sin_polar_[row]},
           (blocks.end - blocks.begin) * kRowsPerBlock,
           held);
}

}  // namespace orbweave
