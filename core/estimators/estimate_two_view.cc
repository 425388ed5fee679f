// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/estimate_two_view.h"

#include <algorithm>
#include <cmath>

#include "core/base/status.h"
#include "core/estimators/bearing_pairs.h"
#include "core/estimators/explain_by_ray_map.h"
#include "core/estimators/match_evidence.h"
#include "core/estimators/refine_two_view.h"
#include "core/estimators/resolve_cheirality.h"
#include "core/estimators/split_by_motion.h"
#include "core/estimators/two_view_ransac.h"
#include "core/geometry/rotation.h"
#include "core/geometry/sphere_cells.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kDegenerateShare = 0.9;  // of the inliers: a rotation or a plane explains the pair
constexpr double kNotedShare = 0.1;       // of the matches: fewer that are fixed do no harm
constexpr double kCarrierSpread = 0.25;   // the carrier covers no more of the sphere
constexpr int kFinalRefits = 3;
constexpr int kFinalSteps = 20;

/// Alternates pose and inliers until these do not grow any more.
ResolvedPose RefineToConvergence(const BearingPairs& pairs,
                                 ResolvedPose best,
                                 double max_error_rad) {
  for (int refit = 0; refit < kFinalRefits; ++refit) {
    const SelectedBearings selected = SelectPairs(pairs, best.inliers);
    const Rigid3 pose = MinimiseEpipolarResiduals(
        best.b_from_a, selected.a, selected.b, 0.5 * max_error_rad, kFinalSteps);
    std::vector<uint32_t> inliers =
        InFrontOfBoth(pairs, EpipolarInliers(pairs, pose, max_error_rad), pose, max_error_rad);
    const bool grows = inliers.size() > best.inliers.size();
    if (inliers.size() >= best.inliers.size()) best = {pose, std::move(inliers)};
    if (!grows) break;
  }
  return best;
}

double MedianAngle(const SelectedBearings& inliers, const Eigen::Quaterniond& R) {
  std::vector<double> angles;
  angles.reserve(inliers.a.size());
  for (size_t i = 0; i < inliers.a.size(); ++i)
    angles.push_back(AngleBetween(R * inliers.a[i], inliers.b[i]));
  const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  return *middle;
}

bool IsSupported(size_t num_inliers, size_t num_putative, const TwoViewOptions& options) {
  const auto share = static_cast<double>(num_inliers) / static_cast<double>(num_putative);
  return num_inliers >= static_cast<size_t>(options.min_inliers) &&
         share >= options.min_inlier_share;
}

/// The inliers as pairs of their own, for the tests of degeneracy.
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

/// Kind, pose and the inliers that belong to them.
struct Verdict {
  TwoViewKind kind = TwoViewKind::kGeneral;
  Rigid3 b_from_a{};
  BearingPairs inliers{};
};

absl::StatusOr<Verdict> Classify(const BearingPairs& pairs,
                                 const ResolvedPose& candidate,
                                 double max_error_rad,
                                 const StageContext& context) {
  Verdict verdict{.b_from_a = candidate.b_from_a, .inliers = Subset(pairs, candidate.inliers)};
  const double enough = kDegenerateShare * static_cast<double>(candidate.inliers.size());
  ORBWEAVE_ASSIGN_OR_RETURN(
      const RayMap rotation,
      ExplainByRotation(verdict.inliers, max_error_rad, kDegenerateShare, context));
  if (static_cast<double>(rotation.inliers.size()) >= enough) {
    verdict.kind = TwoViewKind::kPureRotation;
    verdict.b_from_a = {Eigen::Quaterniond(rotation.M).normalized(), Vector3d::Zero()};
    verdict.inliers = Subset(verdict.inliers, rotation.inliers);
    return verdict;
  }
  ORBWEAVE_ASSIGN_OR_RETURN(
      const RayMap plane,
      ExplainByHomography(verdict.inliers, max_error_rad, kDegenerateShare, context));
  if (static_cast<double>(plane.inliers.size()) >= enough) verdict.kind = TwoViewKind::kPlanar;
  return verdict;
}

/// The geometry of the given matches, whatever they show.
absl::StatusOr<TwoViewGeometry> EstimateFrom(ImagePair pair,
                                             std::span<const Vector3d> bearings_a,
                                             std::span<const Vector3d> bearings_b,
                                             std::span<const FeatureMatch> matches,
                                             double max_error_rad,
                                             const TwoViewOptions& options,
                                             const StageContext& context) {
  TwoViewGeometry geometry{.pair = pair, .num_putative = static_cast<uint32_t>(matches.size())};
  if (matches.size() < static_cast<size_t>(options.min_inliers)) return geometry;
  const BearingPairs pairs = ArrangePairs(bearings_a, bearings_b, matches, context.seed);
  ORBWEAVE_ASSIGN_OR_RETURN(const auto best,
                            FindRelativePose(pairs, max_error_rad, options, context));
  if (!best) return geometry;
  const ResolvedPose candidate =
      RefineToConvergence(pairs, ResolveCheirality(pairs, *best, max_error_rad), max_error_rad);
  if (!IsSupported(candidate.inliers.size(), matches.size(), options)) return geometry;

  ORBWEAVE_ASSIGN_OR_RETURN(const Verdict verdict,
                            Classify(pairs, candidate, max_error_rad, context));
  if (!IsSupported(verdict.inliers.Size(), matches.size(), options)) return geometry;
  geometry.log10_false_alarms =
      EvidenceOf(pairs, verdict.b_from_a, max_error_rad).log10_false_alarms;
  if (geometry.log10_false_alarms > options.max_log10_false_alarms) return geometry;
  geometry.kind = verdict.kind;
  geometry.b_from_a = verdict.b_from_a;
  for (const uint32_t i : verdict.inliers.order) geometry.inliers.push_back(matches[i]);
  std::sort(geometry.inliers.begin(), geometry.inliers.end());
  std::vector<Vector3d> a;
  std::vector<Vector3d> b;
  for (size_t i = 0; i < verdict.inliers.Size(); ++i) {
    a.push_back(verdict.inliers.A(i));
    b.push_back(verdict.inliers.B(i));
  }
  geometry.spread = SphereSpread(a);
  geometry.median_angle_rad = MedianAngle({std::move(a), std::move(b)}, geometry.b_from_a.rotation);
  return geometry;
}

/// Whether nothing but the carrier matches: the pair says nothing of where the cameras were.
bool ShowsTheCarrierAlone(const TwoViewGeometry& geometry, double max_error_rad) {
  return geometry.kind == TwoViewKind::kPureRotation && geometry.spread <= kCarrierSpread &&
         RotationAngle(geometry.b_from_a.rotation) <= max_error_rad;
}

}  // namespace

absl::StatusOr<TwoViewGeometry> EstimateTwoView(ImagePair pair,
                                                std::span<const Vector3d> bearings_a,
                                                std::span<const Vector3d> bearings_b,
                                                std::span<const FeatureMatch> matches,
                                                double max_error_rad,
                                                const TwoViewOptions& options,
                                                const StageContext& context) {
  const auto estimate_from = [&](std::span<const FeatureMatch> chosen) {
    return EstimateFrom(pair, bearings_a, bearings_b, chosen, max_error_rad, options, context);
  };
  const auto num_putative = static_cast<uint32_t>(matches.size());
  const MatchesByMotion split = SplitByMotion(bearings_a, bearings_b, matches, max_error_rad);
  if (static_cast<double>(split.fixed.size()) >= kNotedShare * static_cast<double>(num_putative)) {
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry moved, estimate_from(split.moved));
    moved.num_putative = num_putative;
    if (moved.kind != TwoViewKind::kNone && moved.spread > split.fixed_spread) return moved;
  }
  ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry geometry, estimate_from(matches));
  if (ShowsTheCarrierAlone(geometry, max_error_rad)) {
    return TwoViewGeometry{.pair = pair, .num_putative = num_putative};
  }
  return geometry;
}

}  // namespace orbweave
