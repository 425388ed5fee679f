// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/base/status.h"
#include "core/estimators/intersect_rays.h"
#include "core/estimators/triangulate_rays.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kExhaustiveRays = 8;  // 28 pairs at most
constexpr int kSampledPairs = 64;
constexpr int kMaxRefits = 3;

/// A point and its truncated cost over all rays (MSAC).
struct Candidate {
  Vector3d X = Vector3d::Zero();
  double cost = std::numeric_limits<double>::infinity();
  uint32_t num_inliers = 0;
};

struct Thresholds {
  double max_squared_chord = 0.0;
  double min_angle_rad = 0.0;
};

/// Squared chord 2 (1 - cos) between a ray and the direction to X: equation (10) without the acos.
double SquaredChord(const Ray& ray, const Vector3d& X) {
  return ((X - ray.centre).normalized() - ray.direction).squaredNorm();
}

Candidate Judge(const Rays& rays, const Vector3d& X, double max_squared_chord) {
  Candidate candidate{.X = X, .cost = 0.0};
  for (const Ray& ray : rays) {
    const double squared = SquaredChord(ray, X);
    const bool inlier = squared < max_squared_chord;
    candidate.cost += inlier ? squared : max_squared_chord;
    candidate.num_inliers += inlier ? 1U : 0U;
  }
  return candidate;
}

Rays InliersOf(const Rays& rays, const Candidate& candidate, double max_squared_chord) {
  Rays inliers;
  for (const Ray& ray : rays) {
    if (SquaredChord(ray, candidate.X) < max_squared_chord) inliers.push_back(ray);
  }
  return inliers;
}

double LargestAngle(const Rays& rays, const Vector3d& X) {
  absl::InlinedVector<Vector3d, 16> centres;
  for (const Ray& ray : rays) centres.push_back(ray.centre);
  return MaxTriangulationAngle(X, centres);
}

/// The point of two rays if they meet at a sufficient angle.
std::optional<Vector3d> IntersectPair(const Rays& rays,
                                      uint32_t i,
                                      uint32_t j,
                                      double min_angle_rad) {
  const Rays pair = {rays[i], rays[j]};
  const std::optional<Vector3d> X = IntersectRays(pair);
  if (!X || LargestAngle(pair, *X) < min_angle_rad) return std::nullopt;
  return X;
}

/// The best candidate over all pairs of few rays, or over a fixed sample of the pairs of many.
Candidate BestPair(const Rays& rays, const Thresholds& thresholds) {
  Candidate best;
  const auto consider = [&](uint32_t i, uint32_t j) {
    const std::optional<Vector3d> X = IntersectPair(rays, i, j, thresholds.min_angle_rad);
    if (!X) return;
    const Candidate candidate = Judge(rays, *X, thresholds.max_squared_chord);
    if (candidate.cost < best.cost) best = candidate;
  };
  const auto count = static_cast<uint32_t>(rays.size());
  if (count <= kExhaustiveRays) {
    for (uint32_t i = 0; i < count; ++i) {
      for (uint32_t j = i + 1; j < count; ++j) consider(i, j);
    }
    return best;
  }
  Random random(count);
  for (int trial = 0; trial < kSampledPairs; ++trial) {
    const uint32_t i = random.Index(count);
    consider(i, (i + 1 + random.Index(count - 1)) % count);
  }
  return best;
}

/// Local optimisation: fits all inliers, again while the cost falls.
Candidate Polish(const Rays& rays, Candidate best, double max_squared_chord) {
  for (int refit = 0; refit < kMaxRefits; ++refit) {
    const std::optional<Vector3d> X = IntersectRays(InliersOf(rays, best, max_squared_chord));
    if (!X) break;
    const Candidate candidate = Judge(rays, *X, max_squared_chord);
    if (!(candidate.cost < best.cost)) break;
    best = candidate;
  }
  return best;
}

Candidate BestCandidate(const Rays& rays, const Thresholds& thresholds) {
  // All rays at once first: most tracks are clean.
  if (const std::optional<Vector3d> X = IntersectRays(rays)) {
    const Candidate all = Judge(rays, *X, thresholds.max_squared_chord);
    if (all.num_inliers == rays.size()) return all;
  }
  return Polish(rays, BestPair(rays, thresholds), thresholds.max_squared_chord);
}

}  // namespace

std::optional<RobustTriangulation> TriangulateRobustly(std::span<const Rigid3> cams_from_world,
                                                       std::span<const Vector3d> bearings,
                                                       double max_error_rad,
                                                       double min_angle_rad) {
  ORBWEAVE_CHECK(cams_from_world.size() == bearings.size());
  if (bearings.size() < 2) return std::nullopt;
  const double max_chord = 2.0 * std::sin(0.5 * max_error_rad);
  const Thresholds thresholds{.max_squared_chord = max_chord * max_chord,
                              .min_angle_rad = min_angle_rad};
  const Rays rays = RaysFromFirstCamera(cams_from_world, bearings);
  const Candidate best = BestCandidate(rays, thresholds);
  if (best.num_inliers < 2) return std::nullopt;
  const Rays inliers = InliersOf(rays, best, thresholds.max_squared_chord);
  if (LargestAngle(inliers, best.X) < min_angle_rad) return std::nullopt;

  RobustTriangulation result;
  result.point_in_world = cams_from_world[0].Centre() + best.X;
  result.num_inliers = best.num_inliers;
  result.is_inlier.reserve(rays.size());
  for (const Ray& ray : rays) {
    result.is_inlier.push_back(SquaredChord(ray, best.X) < thresholds.max_squared_chord ? 1 : 0);
  }
  return result;
}

}  // namespace orbweave
