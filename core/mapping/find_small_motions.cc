// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/find_small_motions.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/estimators/refine_two_view.h"
#include "core/geometry/epipolar.h"
#include "core/geometry/rotation.h"
#include "core/geometry/symmetric_eigen.h"
#include "core/mapping/model/correspondence_graph.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kFewest = 100;   // matches, as of a seed
constexpr double kClearly = 3.0;  // times as far apart as from their planes
constexpr double kTowards = 0.9;  // of the matches
constexpr double kUsualErrorPx = 0.5;
constexpr int kSteps = 20;

/// The rays of a pair's matches.
struct PairRays {
  std::vector<Vector3d> a;
  std::vector<Vector3d> b;
};

PairRays RaysOf(const ClusterProblem& problem, const TwoViewGeometry& pair) {
  const ClusterImage& a = problem.images[*SlotOf(problem, pair.pair.a)];
  const ClusterImage& b = problem.images[*SlotOf(problem, pair.pair.b)];
  PairRays rays;
  for (const FeatureMatch& match : pair.inliers) {
    rays.a.push_back(a.bearings[match.a]);
    rays.b.push_back(b.bearings[match.b]);
  }
  return rays;
}

/// The rotation with the direction in which most of what it leaves moves.
Rigid3 WithDirection(const Eigen::Quaterniond& rotation, const PairRays& rays) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Vector3d moved = Vector3d::Zero();
  for (size_t i = 0; i < rays.a.size(); ++i) {
    const Vector3d turned = rotation * rays.a[i];
    const Vector3d normal = turned.cross(rays.b[i]);
    sum += normal * normal.transpose();
    moved += rays.b[i] - turned;
  }
  const Vector3d direction = EigenOf<3>(sum).vectors.col(0);
  return {rotation, direction.dot(moved) < 0.0 ? Vector3d(-direction) : direction};
}

bool IsTold(const Rigid3& b_from_a, const PairRays& rays, double& median_angle_rad) {
  std::vector<double> apart_rad;
  std::vector<double> off_rad;
  size_t towards = 0;
  for (size_t i = 0; i < rays.a.size(); ++i) {
    const Vector3d turned = b_from_a.rotation * rays.a[i];
    apart_rad.push_back(AngleBetween(turned, rays.b[i]));
    off_rad.push_back(SymmetricEpipolarAngle(b_from_a, rays.a[i], rays.b[i]));
    towards += (rays.b[i] - turned).dot(b_from_a.translation) > 0.0 ? 1 : 0;
  }
  median_angle_rad = UpperMedian(std::move(apart_rad));
  return median_angle_rad >= kClearly * UpperMedian(std::move(off_rad)) &&
         static_cast<double>(towards) >= kTowards * static_cast<double>(rays.a.size());
}

/// Makes the pair a general one; false where it tells no direction.
bool TellMotion(const ClusterProblem& problem, TwoViewGeometry& pair) {
  if (pair.inliers.size() < kFewest) return false;
  const PairRays rays = RaysOf(problem, pair);
  const double usual_rad =
      problem.images[*SlotOf(problem, pair.pair.a)].camera.AngleFromPixels(kUsualErrorPx);
  const Rigid3 b_from_a = MinimiseEpipolarResiduals(
      WithDirection(pair.b_from_a.rotation, rays), rays.a, rays.b, usual_rad, kSteps);
  if (!IsTold(b_from_a, rays, pair.median_angle_rad)) return false;
  pair.b_from_a = b_from_a;
  pair.kind = TwoViewKind::kGeneral;
  return true;
}

}  // namespace

std::optional<ClusterProblem> FindSmallMotions(const ClusterProblem& problem) {
  const auto is_motion = [](const TwoViewGeometry& pair) { return HasBaseline(pair.kind); };
  if (std::ranges::any_of(problem.pairs, is_motion)) return std::nullopt;
  ClusterProblem told = problem;
  size_t num_told = 0;
  for (TwoViewGeometry& pair : told.pairs)
    num_told += pair.kind == TwoViewKind::kPureRotation && TellMotion(problem, pair) ? 1 : 0;
  if (num_told == 0) return std::nullopt;
  return told;
}

}  // namespace orbweave
