// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/two_view_inliers.h"

#include <algorithm>
#include <utility>

#include "core/base/quantile.h"
#include "core/estimators/refine_two_view.h"
#include "core/geometry/rotation.h"
#include "core/geometry/sphere_cells.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr int kFinalRefits = 3;
constexpr int kFinalSteps = 20;

double MedianAngle(const SelectedBearings& inliers, const Eigen::Quaterniond& R) {
  std::vector<double> angles;
  angles.reserve(inliers.a.size());
  for (size_t i = 0; i < inliers.a.size(); ++i)
    angles.push_back(AngleBetween(R * inliers.a[i], inliers.b[i]));
  return UpperMedian(std::move(angles));
}

}  // namespace

bool HasClearlyMoved(const Eigen::Quaterniond& rotation,
                     const Eigen::Vector3d& a,
                     const Eigen::Vector3d& b,
                     double max_error_rad) {
  constexpr double kErrors = 2.0;
  return AngleBetween(rotation * a, b) > kErrors * max_error_rad;
}

BearingPairs Subset(const BearingPairs& pairs, std::span<const uint32_t> indices) {
  BearingPairs subset;
  for (const uint32_t i : indices) {
    subset.order.push_back(pairs.order[i]);
    for (int k = 0; k < 3; ++k) {
      subset.a[k].push_back(pairs.a[k][i]);
      subset.b[k].push_back(pairs.b[k][i]);
    }
  }
  return subset;
}

std::vector<uint32_t> InliersOf(const BearingPairs& pairs,
                                const Rigid3& b_from_a,
                                double max_error_rad) {
  return InFrontOfBoth(
      pairs, EpipolarInliers(pairs, b_from_a, max_error_rad), b_from_a, max_error_rad);
}

Rigid3 RefinePose(const BearingPairs& pairs,
                  std::span<const uint32_t> indices,
                  const Rigid3& b_from_a,
                  double max_error_rad) {
  const SelectedBearings selected = SelectPairs(pairs, indices);
  return MinimiseEpipolarResiduals(
      b_from_a, selected.a, selected.b, 0.5 * max_error_rad, kFinalSteps);
}

ResolvedPose RefineToConvergence(const BearingPairs& pairs,
                                 ResolvedPose best,
                                 double max_error_rad) {
  for (int refit = 0; refit < kFinalRefits; ++refit) {
    const Rigid3 pose = RefinePose(pairs, best.inliers, best.b_from_a, max_error_rad);
    std::vector<uint32_t> inliers = InliersOf(pairs, pose, max_error_rad);
    const bool grows = inliers.size() > best.inliers.size();
    if (inliers.size() >= best.inliers.size()) best = {pose, std::move(inliers)};
    if (!grows) break;
  }
  return best;
}

void SetInliers(const BearingPairs& inliers,
                std::span<const FeatureMatch> matches,
                TwoViewGeometry& geometry) {
  geometry.inliers.clear();
  std::vector<Vector3d> a;
  std::vector<Vector3d> b;
  for (size_t i = 0; i < inliers.Size(); ++i) {
    geometry.inliers.push_back(matches[inliers.order[i]]);
    a.push_back(inliers.A(i));
    b.push_back(inliers.B(i));
  }
  std::sort(geometry.inliers.begin(), geometry.inliers.end());
  geometry.spread = SphereSpread(a);
  geometry.median_angle_rad = MedianAngle({std::move(a), std::move(b)}, geometry.b_from_a.rotation);
}

}  // namespace orbweave
