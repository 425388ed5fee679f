// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/match_guided.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/features/accept_matches.h"
#include "core/features/descriptor_distance.h"
#include "core/features/nearest_two.h"

namespace orbweave {
namespace {

using std::numbers::pi;

/// Bearings about the translation axis, in frame b: the angle from the axis (direction of the
/// centre of a) and the azimuth, equal for all bearings of one epipolar half plane.
struct AxialFeature {
  double azimuth_rad = 0.0;  ///< [-pi, pi]
  double cos_azimuth = 1.0;
  double sin_azimuth = 0.0;
  double polar_rad = 0.0;  ///< [0, pi]
  double sin_polar = 0.0;
  FeatureIndex index = 0;
};

/// Rotation that takes the axis to z.
Eigen::Quaterniond AxialFrame(const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond::FromTwoVectors(axis, Eigen::Vector3d::UnitZ());
}

std::vector<AxialFeature> AboutAxis(const Features& features,
                                    const Eigen::Quaterniond& axial_from_cam) {
  std::vector<AxialFeature> axial;
  for (FeatureIndex i = 0; i < features.size(); ++i) {
    const Eigen::Vector3d p = axial_from_cam * features.Bearing(i);
    const double sin_polar = std::hypot(p.x(), p.y());
    const double azimuth = std::atan2(p.y(), p.x());
    axial.push_back({.azimuth_rad = azimuth,
                     .cos_azimuth = std::cos(azimuth),
                     .sin_azimuth = std::sin(azimuth),
                     .polar_rad = std::atan2(sin_polar, p.z()),
                     .sin_polar = sin_polar,
                     .index = i});
  }
  return axial;
}

/// Whether some point in front of both spheres has these bearings up to `max_error`. Its bearing in
/// b lies on the epipolar half plane of a, between the axis (the point at the centre of a) and
/// the bearing of a (the point at infinity).
class Epipolar {
 public:
  explicit Epipolar(double max_error_rad)
      : max_error_rad_(max_error_rad), sin_error_(std::sin(std::min(max_error_rad, 0.5 * pi))) {}

  /// Half width of the azimuths that can agree with a feature.
  [[nodiscard]] double AzimuthRange(const AxialFeature& a) const {
    return a.sin_polar > sin_error_ ? std::asin(sin_error_ / a.sin_polar) : pi;
  }

  [[nodiscard]] bool Agree(const AxialFeature& a, const AxialFeature& b) const {
    if (b.polar_rad > a.polar_rad + max_error_rad_) return false;
    const double sin_polar = std::max(a.sin_polar, b.sin_polar);
    if (sin_polar <= sin_error_)
      return std::abs(a.polar_rad - b.polar_rad) < 0.5 * pi;  // at one epipole
    const double cosine = a.cos_azimuth * b.cos_azimuth + a.sin_azimuth * b.sin_azimuth;
    const double sine = a.sin_azimuth * b.cos_azimuth - a.cos_azimuth * b.sin_azimuth;
    return cosine > 0.0 && sin_polar * std::abs(sine) <= sin_error_;
  }

 private:
  double max_error_rad_;
  double sin_error_;
};

/// Calls `visit` for the features of `sorted` with azimuths within +-range of `azimuth`, across
/// the wrap at +-pi. Every feature once at most.
template <typename Visit>
void ForAzimuthRange(const std::vector<AxialFeature>& sorted,
                     double azimuth,
                     double range,
                     const Visit& visit) {
  const auto visit_between = [&](double low, double high) {
    const auto first = std::lower_bound(
        sorted.begin(), sorted.end(), low, [](const AxialFeature& f, double value) {
          return f.azimuth_rad < value;
        });
    for (auto it = first; it != sorted.end() && it->azimuth_rad <= high; ++it) visit(*it);
  };
  if (range >= pi) return visit_between(-pi, pi);
  const double low = azimuth - range;
  const double high = azimuth + range;
  visit_between(std::max(low, -pi), std::min(high, pi));
  if (low < -pi) visit_between(low + 2.0 * pi, pi);
  if (high > pi) visit_between(-pi, high - 2.0 * pi);
}

void Update(NearestTwo& nearest, int32_t distance, FeatureIndex index) {
  if (distance < nearest.best || (distance == nearest.best && index < nearest.index)) {
    nearest.second = nearest.best;
    nearest.best = distance;
    nearest.index = index;
  } else {
    nearest.second = std::min(nearest.second, distance);
  }
}

}  // namespace

std::vector<FeatureMatch> MatchGuided(const Features& a,
                                      const Features& b,
                                      const Rigid3& b_from_a,
                                      double max_error_rad,
                                      const MatchOptions& options) {
  if (a.descriptors.empty() || b.descriptors.empty() || b_from_a.translation.isZero()) return {};
  const Eigen::Quaterniond axial_from_b = AxialFrame(b_from_a.translation);
  const std::vector<AxialFeature> axial_a = AboutAxis(a, axial_from_b * b_from_a.rotation);
  std::vector<AxialFeature> axial_b = AboutAxis(b, axial_from_b);
  std::sort(axial_b.begin(), axial_b.end(), [](const AxialFeature& x, const AxialFeature& y) {
    return x.azimuth_rad != y.azimuth_rad ? x.azimuth_rad < y.azimuth_rad : x.index < y.index;
  });

  const Epipolar epipolar(max_error_rad);
  NearestTwoBothWays nearest{.of_a = std::vector<NearestTwo>(a.size()),
                             .of_b = std::vector<NearestTwo>(b.size())};
  for (const AxialFeature& of_a : axial_a) {
    ForAzimuthRange(
        axial_b, of_a.azimuth_rad, epipolar.AzimuthRange(of_a), [&](const AxialFeature& of_b) {
          if (!epipolar.Agree(of_a, of_b)) return;
          const int32_t distance =
              SquaredDistance(a.Descriptor(of_a.index), b.Descriptor(of_b.index));
          Update(nearest.of_a[of_a.index], distance, of_b.index);
          Update(nearest.of_b[of_b.index], distance, of_a.index);
        });
  }
  return AcceptMatches(nearest, {options.guided_max_ratio, options.max_distance, true});
}

}  // namespace orbweave
