// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/find_small_motions.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/estimators/refine_two_view.h"
#include "core/estimators/split_by_height.h"
#include "core/geometry/epipolar.h"
#include "core/geometry/rotation.h"
#include "core/geometry/symmetric_eigen.h"
#include "core/mapping/model/correspondence_graph.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kFewest = 100;      // matches, as of a seed
constexpr double kClearly = 3.0;     // times as far apart as most are from their planes
constexpr double kTowards = 0.9;     // of the matches
constexpr size_t kFewestMoved = 30;  // of which nine in ten agree by chance once in 200,000 pairs
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

/// How a match has moved beyond what the rotation makes of it.
struct Motion {
  double apart_rad = 0.0;
  double off_rad = 0.0;  ///< from the epipolar planes
  bool is_towards = false;
  bool is_high = false;
};

std::vector<Motion> MotionsOf(const Rigid3& b_from_a, const PairRays& rays) {
  std::vector<Motion> motions;
  for (size_t i = 0; i < rays.a.size(); ++i) {
    const Vector3d turned = b_from_a.rotation * rays.a[i];
    motions.push_back({.apart_rad = AngleBetween(turned, rays.b[i]),
                       .off_rad = SymmetricEpipolarAngle(b_from_a, rays.a[i], rays.b[i]),
                       .is_towards = (rays.b[i] - turned).dot(b_from_a.translation) > 0.0,
                       .is_high = IsEitherHigh(rays.a[i], rays.b[i])});
  }
  return motions;
}

double MedianOf(const std::vector<Motion>& motions, double Motion::*what) {
  std::vector<double> values;
  for (const Motion& motion : motions) values.push_back(motion.*what);
  return UpperMedian(std::move(values));
}

bool AreTold(const std::vector<Motion>& motions) {
  const double clear_rad = kClearly * MedianOf(motions, &Motion::off_rad);
  if (MedianOf(motions, &Motion::apart_rad) < clear_rad) return false;
  size_t moved = 0;
  size_t towards = 0;
  for (const Motion& motion : motions) {
    if (motion.is_high || motion.apart_rad < clear_rad) continue;
    ++moved;
    towards += motion.is_towards ? 1 : 0;
  }
  return moved >= kFewestMoved &&
         static_cast<double>(towards) >= kTowards * static_cast<double>(moved);
}

/// Makes the pair a general one; false where it tells no direction.
bool TellMotion(const ClusterProblem& problem, TwoViewGeometry& pair) {
  if (pair.inliers.size() < kFewest) return false;
  const PairRays rays = RaysOf(problem, pair);
  const double usual_rad =
      problem.images[*SlotOf(problem, pair.pair.a)].camera.AngleFromPixels(kUsualErrorPx);
  const Rigid3 b_from_a = MinimiseEpipolarResiduals(
      WithDirection(pair.b_from_a.rotation, rays), rays.a, rays.b, usual_rad, kSteps);
  const std::vector<Motion> motions = MotionsOf(b_from_a, rays);
  if (!AreTold(motions)) return false;
  pair.median_angle_rad = MedianOf(motions, &Motion::apart_rad);
  pair.b_from_a = b_from_a;
  pair.kind = TwoViewKind::kGeneral;
  return true;
}

}  // namespace

std::optional<ClusterProblem> FindSmallMotions(const ClusterProblem& problem) {
  ClusterProblem told = problem;
  size_t num_told = 0;
  for (TwoViewGeometry& pair : told.pairs)
    num_told += pair.kind == TwoViewKind::kPureRotation && TellMotion(problem, pair) ? 1 : 0;
  if (num_told == 0) return std::nullopt;
  return told;
}

}  // namespace orbweave
