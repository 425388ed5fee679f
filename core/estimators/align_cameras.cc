// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/estimators/align_cameras.h"

#include <cmath>
#include <vector>

#include "core/base/status.h"
#include "core/estimators/estimate_similarity.h"
#include "core/geometry/symmetric_eigen.h"

namespace orbweave {
namespace {

constexpr double kThin = 0.01;       // width over length of centres that lie on a line
constexpr double kAxisShare = 0.01;  // distance of the points on the axes, of the length
constexpr double kOnePlace = 1e-12;  // length over distance from the origin that is mere rounding

/// Standard deviations of a set of centres along its longest and its second longest direction.
struct Extent {
  double length = 0.0;
  double width = 0.0;
  bool is_one_place = true;
};

Extent ExtentOf(std::span<const Rigid3> cams, std::span<const double> weights) {
  const auto weight = [&](size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  double sum = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < cams.size(); ++i) {
    sum += weight(i);
    mean += weight(i) * cams[i].Centre();
  }
  mean /= sum;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < cams.size(); ++i) {
    const Eigen::Vector3d from_mean = cams[i].Centre() - mean;
    moment += weight(i) / sum * from_mean * from_mean.transpose();
  }
  const Eigen::Vector3d variance = EigenOf<3>(moment).values.cwiseMax(0.0);
  const double length = std::sqrt(variance[2]);
  return {length, std::sqrt(variance[1]), !(length > kOnePlace * mean.norm())};
}

/// Each centre, and behind all centres, where `axis_length` is not zero, three points per camera at
/// that distance along its axes.
std::vector<Eigen::Vector3d> PointsOf(std::span<const Rigid3> cams, double axis_length) {
  std::vector<Eigen::Vector3d> points;
  for (const Rigid3& cam : cams) points.push_back(cam.Centre());
  if (axis_length == 0.0) return points;
  for (const Rigid3& cam : cams) {
    const Eigen::Matrix3d world_from_cam = cam.rotation.conjugate().toRotationMatrix();
    for (int axis = 0; axis < 3; ++axis) {
      points.emplace_back(cam.Centre() + axis_length * world_from_cam.col(axis));
    }
  }
  return points;
}

}  // namespace

std::optional<Sim3> AlignCameras(std::span<const Rigid3> cams_from_a,
                                 std::span<const Rigid3> cams_from_b,
                                 std::span<const double> weights) {
  ORBWEAVE_CHECK(cams_from_a.size() == cams_from_b.size());
  ORBWEAVE_CHECK(weights.empty() || weights.size() == cams_from_a.size());
  if (cams_from_a.size() < 3) return std::nullopt;
  const Extent a = ExtentOf(cams_from_a, weights);
  const Extent b = ExtentOf(cams_from_b, weights);
  if (a.is_one_place || b.is_one_place) return std::nullopt;
  const bool thin = a.width < kThin * a.length || b.width < kThin * b.length;
  const double share = thin ? kAxisShare : 0.0;
  std::vector<double> weight_of_point(weights.begin(), weights.end());
  if (thin && !weights.empty()) {
    for (const double weight : weights) weight_of_point.insert(weight_of_point.end(), 3, weight);
  }
  return FitSimilarity(PointsOf(cams_from_a, share * a.length),
                       PointsOf(cams_from_b, share * b.length),
                       weight_of_point);
}

}  // namespace orbweave
