// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/matches_besides_plane.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "core/estimators/bearing_pairs.h"
#include "core/estimators/explain_by_ray_map.h"
#include "core/geometry/rotation.h"
#include "core/geometry/sphere_cells.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kCarries = 0.4;  // of the inliers: without them little would be left
constexpr int kCells = 16;        // a side: cells as wide as a house is from across the street
constexpr uint32_t kCovers = 2;   // one match may lie on the plane by chance
constexpr double kParallaxErrors = 2.0;  // what is far agrees with any plane

std::vector<FeatureMatch> NearInliers(std::span<const Vector3d> bearings_a,
                                      std::span<const Vector3d> bearings_b,
                                      const TwoViewGeometry& geometry,
                                      double max_error_rad) {
  std::vector<FeatureMatch> near;
  std::ranges::copy_if(geometry.inliers, std::back_inserter(near), [&](const FeatureMatch& match) {
    return AngleBetween(geometry.b_from_a.rotation * bearings_a[match.a], bearings_b[match.b]) >
           kParallaxErrors * max_error_rad;
  });
  return near;
}

/// The part of a sphere that a plane covers.
class Cover {
 public:
  void Add(const Vector3d& bearing) { ++counts_[SphereCell(bearing, kCells)]; }
  [[nodiscard]] bool Holds(const Vector3d& bearing) const {
    return counts_[SphereCell(bearing, kCells)] >= kCovers;
  }

 private:
  std::vector<uint32_t> counts_ = std::vector<uint32_t>(size_t{kCells} * kCells, 0);
};

}  // namespace

absl::StatusOr<std::optional<std::vector<FeatureMatch>>> MatchesBesidesPlane(
    std::span<const Vector3d> bearings_a,
    std::span<const Vector3d> bearings_b,
    std::span<const FeatureMatch> matches,
    const TwoViewGeometry& geometry,
    double max_error_rad,
    const StageContext& context) {
  const double fewest = kCarries * static_cast<double>(geometry.inliers.size());
  const std::vector<FeatureMatch> near =
      NearInliers(bearings_a, bearings_b, geometry, max_error_rad);
  if (static_cast<double>(near.size()) < fewest) return std::nullopt;
  const BearingPairs pairs = ArrangePairs(bearings_a, bearings_b, near, context.seed);
  ORBWEAVE_ASSIGN_OR_RETURN(
      const RayMap plane,
      ExplainByPlane(pairs, geometry.b_from_a, max_error_rad, kCarries, context));
  if (static_cast<double>(plane.inliers.size()) < fewest) return std::nullopt;
  Cover in_a;
  Cover in_b;
  for (const uint32_t i : plane.inliers) {
    in_a.Add(pairs.A(i));
    in_b.Add(pairs.B(i));
  }
  std::vector<FeatureMatch> elsewhere;
  std::ranges::copy_if(matches, std::back_inserter(elsewhere), [&](const FeatureMatch& match) {
    return !in_a.Holds(bearings_a[match.a]) && !in_b.Holds(bearings_b[match.b]);
  });
  return elsewhere;
}

}  // namespace orbweave
