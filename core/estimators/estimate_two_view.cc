// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/estimate_two_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "core/base/status.h"
#include "core/estimators/bearing_pairs.h"
#include "core/estimators/explain_by_ray_map.h"
#include "core/estimators/leave_out_sky.h"
#include "core/estimators/match_evidence.h"
#include "core/estimators/matched_bearings.h"
#include "core/estimators/matches_besides_plane.h"
#include "core/estimators/resolve_cheirality.h"
#include "core/estimators/split_by_height.h"
#include "core/estimators/split_by_motion.h"
#include "core/estimators/two_view_inliers.h"
#include "core/estimators/two_view_ransac.h"
#include "core/geometry/rotation.h"
#include "core/geometry/sphere_cells.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kDegenerateShare = 0.9;  // of the inliers: a rotation or a plane explains the pair
constexpr double kNotedShare = 0.1;       // of the matches: fewer that are fixed do no harm
constexpr double kCarrierSpread = 0.25;   // the carrier covers no more of the sphere
// What moves by itself is seen within half of the horizon, where less than one inlier in a hundred
// is by chance elsewhere: a scene has one place in eight, and five at least, in either half.
constexpr double kEitherHalf = 0.125;
constexpr uint32_t kFewestPlaces = 5;
constexpr double kMostlySky = 0.5;    // of the inliers: the sky outvotes the scene
constexpr double kLowFeatures = 0.1;  // of all features: a common scene has matches there
// Of what is no sky that many agree with its pose: it was not fitted to them, and one in a hundred
// would by chance.
constexpr double kSameScene = 0.5;
constexpr double kFewInScene = 5.0;
constexpr double kAsEvident = 0.8;  // sky and scene then agree in one geometry
// Of the evidence elsewhere that another pose has: aliases of a facade show none to a twentieth,
// right poses a quarter and more.
constexpr double kHardly = 0.2;
constexpr double kClearlyMore = 10.0;  // decades: a moving bus counts as three matches, some four
// A facade that is matched a window further on turns no camera, but by what a plane leaves open.
constexpr double kTurned_rad = 1.0;

bool IsSupported(size_t num_inliers, size_t num_putative, const TwoViewOptions& options) {
  const auto share = static_cast<double>(num_inliers) / static_cast<double>(num_putative);
  return num_inliers >= static_cast<size_t>(options.min_inliers) &&
         share >= options.min_inlier_share;
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
                                             const MatchedBearings& bearings,
                                             std::span<const FeatureMatch> matches,
                                             const TwoViewHints& hints,
                                             const TwoViewOptions& options,
                                             const StageContext& context) {
  const double max_error_rad = bearings.max_error_rad;
  TwoViewGeometry geometry{.pair = pair, .num_putative = static_cast<uint32_t>(matches.size())};
  if (matches.size() < static_cast<size_t>(options.min_inliers)) return geometry;
  const BearingPairs pairs = bearings.Arranged(matches);
  ORBWEAVE_ASSIGN_OR_RETURN(const auto best,
                            FindRelativePose(pairs, hints, max_error_rad, options, context));
  if (!best) return geometry;
  const ResolvedPose candidate =
      RefineToConvergence(pairs, ResolveCheirality(pairs, *best, max_error_rad), max_error_rad);
  if (!IsSupported(candidate.inliers.size(), matches.size(), options)) return geometry;

  ORBWEAVE_ASSIGN_OR_RETURN(const Verdict verdict,
                            Classify(pairs, candidate, max_error_rad, context));
  if (!IsSupported(verdict.inliers.Size(), matches.size(), options)) return geometry;
  geometry.log10_false_alarms =
      EvidenceOf(pairs, verdict.b_from_a, max_error_rad, hints.Sample()).log10_false_alarms;
  if (geometry.log10_false_alarms > options.max_log10_false_alarms) return geometry;
  geometry.kind = verdict.kind;
  geometry.b_from_a = verdict.b_from_a;
  SetInliers(verdict.inliers, matches, geometry);
  return geometry;
}

/// Whether nothing but the carrier matches: the pair says nothing of where the cameras were.
bool ShowsTheCarrierAlone(const TwoViewGeometry& geometry, double max_error_rad) {
  return geometry.kind == TwoViewKind::kPureRotation && geometry.spread <= kCarrierSpread &&
         RotationAngle(geometry.b_from_a.rotation) <= max_error_rad;
}

/// Whether the inliers lie all around the camera, as nothing does that drives by.
bool IsAllAround(const TwoViewGeometry& geometry, std::span<const Vector3d> bearings_a) {
  std::vector<Vector3d> inliers;
  for (const FeatureMatch& match : geometry.inliers) inliers.push_back(bearings_a[match.a]);
  const PlacesAround places = CountPlacesAround(inliers);
  return places.of_emptier_half >= kFewestPlaces &&
         places.of_emptier_half >= kEitherHalf * places.all;
}

/// Whether one pose may be the other a window further on: turned alike, but led elsewhere.
bool MayBeAliases(const Rigid3& x, const Rigid3& y) {
  return AngleBetween(x.translation, y.translation) >= kOneDirection_rad &&
         RotationAngle(x.rotation.conjugate() * y.rotation) < kTurned_rad;
}

/// Estimates from what two panoramas match, and looks below the sky.
struct PairView {
  ImagePair pair{};
  MatchedBearings bearings;
  const TwoViewOptions& options;
  const StageContext& context;
  const TwoViewHints& hints;  ///< the order is that of all matches that are passed

  [[nodiscard]] absl::StatusOr<TwoViewGeometry> From(std::span<const FeatureMatch> matches) const {
    return EstimateFrom(pair, bearings, matches, hints, options, context);
  }

  /// Whether what has moved is the scene, and what has not the carrier: it covers more of the
  /// sphere; or it lies all around and has a pose of its own, in which most of what is fixed would
  /// be elsewhere. A roof and the edge of what it hides cover more than the horizon does.
  [[nodiscard]] bool IsTheScene(const TwoViewGeometry& moved, const MatchesByMotion& split) const {
    if (moved.spread > split.fixed_spread) return true;
    return IsAllAround(moved, bearings.a) &&
           CountAgreeing(split.fixed, moved) < kSameScene * static_cast<double>(split.fixed.size());
  }

  /// The geometry of the scene where that of all matches is the sky's; none where the sky alone
  /// matches, be it in several ways, as clouds do that look alike.
  [[nodiscard]] absl::StatusOr<TwoViewGeometry> BelowSky(
      std::span<const FeatureMatch> matches) const {
    ORBWEAVE_ASSIGN_OR_RETURN(const TwoViewGeometry all, From(matches));
    if (all.kind == TwoViewKind::kNone) return all;
    const std::vector<FeatureMatch> sky = SkyOf(bearings, all);
    if (!IsMostly(sky, all)) return WithoutMovingSky(all, matches);
    std::vector<FeatureMatch> rest;
    std::ranges::copy_if(matches, std::back_inserter(rest), [&](const FeatureMatch& match) {
      return !std::ranges::binary_search(sky, match);
    });
    const double evidence_of_all = Log10FalseAlarms(rest, all);
    ORBWEAVE_ASSIGN_OR_RETURN(const TwoViewGeometry scene, From(rest));
    const bool is_scene = scene.kind != TwoViewKind::kNone &&
                          !ShowsTheCarrierAlone(scene, bearings.max_error_rad) &&
                          !IsMostly(SkyOf(bearings, scene), scene);
    if (is_scene && kAsEvident * scene.log10_false_alarms < evidence_of_all)
      return WithoutMovingSky(bearings.Extended(scene, matches), matches);
    if (evidence_of_all <= options.max_log10_false_alarms || !SeesTheGround() ||
        CountAgreeing(rest, all) >=
            std::max(kFewInScene, kSameScene * static_cast<double>(rest.size())))
      return WithoutMovingSky(all, matches);
    return TwoViewGeometry{.pair = pair, .num_putative = all.num_putative};
  }

  /// Another geometry where one plane carries `all`, and what matches elsewhere hardly agrees with
  /// `all` and clearly with that one (MatchesBesidesPlane).
  [[nodiscard]] absl::StatusOr<TwoViewGeometry> BesidesPlane(
      TwoViewGeometry all, std::span<const FeatureMatch> matches) const {
    if (all.kind == TwoViewKind::kNone || all.kind == TwoViewKind::kPureRotation) return all;
    ORBWEAVE_ASSIGN_OR_RETURN(
        const std::optional<std::vector<FeatureMatch>> elsewhere,
        MatchesBesidesPlane(bearings.a, bearings.b, matches, all, bearings.max_error_rad, context));
    if (!elsewhere) return all;
    ORBWEAVE_ASSIGN_OR_RETURN(const TwoViewGeometry other, BelowSky(*elsewhere));
    if (other.kind != TwoViewKind::kGeneral || !MayBeAliases(all.b_from_a, other.b_from_a))
      return all;
    const double of_all = Log10FalseAlarmsBelowSky(*elsewhere, all);
    const double of_other = Log10FalseAlarmsBelowSky(*elsewhere, other);
    if (of_all <= kHardly * of_other || of_other > of_all - kClearlyMore) return all;
    return WithoutMovingSky(bearings.Extended(other, matches), matches);
  }

 private:
  [[nodiscard]] static bool IsMostly(std::span<const FeatureMatch> sky,
                                     const TwoViewGeometry& geometry) {
    return static_cast<double>(sky.size()) >=
           kMostlySky * static_cast<double>(geometry.inliers.size());
  }

  [[nodiscard]] double Log10FalseAlarms(std::span<const FeatureMatch> matches,
                                        const TwoViewGeometry& geometry) const {
    const BearingPairs pairs = bearings.Arranged(matches);
    return EvidenceOf(pairs, geometry.b_from_a, bearings.max_error_rad, hints.Sample())
        .log10_false_alarms;
  }

  /// Of the matches that are no sky under a geometry.
  [[nodiscard]] double Log10FalseAlarmsBelowSky(std::span<const FeatureMatch> matches,
                                                const TwoViewGeometry& geometry) const {
    std::vector<FeatureMatch> scene;
    std::ranges::copy_if(matches, std::back_inserter(scene), [&](const FeatureMatch& match) {
      return !MayBeSky(bearings, match, geometry);
    });
    return Log10FalseAlarms(scene, geometry);
  }

  /// How many of the matches agree with a geometry.
  [[nodiscard]] double CountAgreeing(std::span<const FeatureMatch> matches,
                                     const TwoViewGeometry& geometry) const {
    return static_cast<double>(bearings.Agreeing(bearings.Arranged(matches), geometry).size());
  }

  [[nodiscard]] TwoViewGeometry WithoutMovingSky(TwoViewGeometry geometry,
                                                 std::span<const FeatureMatch> putative) const {
    return LeaveOutSky(bearings, std::move(geometry), putative, options.min_inliers);
  }

  /// Whether both panoramas have features below, so that a scene in common would have matches
  /// there.
  [[nodiscard]] bool SeesTheGround() const {
    return std::ranges::all_of(std::array{bearings.a, bearings.b}, [](const auto& of_panorama) {
      const auto high = static_cast<double>(std::ranges::count_if(of_panorama, IsHigh));
      return high <= (1.0 - kLowFeatures) * static_cast<double>(of_panorama.size());
    });
  }
};

}  // namespace

absl::StatusOr<TwoViewGeometry> EstimateTwoView(ImagePair pair,
                                                std::span<const Vector3d> bearings_a,
                                                std::span<const Vector3d> bearings_b,
                                                std::span<const FeatureMatch> matches,
                                                double max_error_rad,
                                                const TwoViewOptions& options,
                                                const StageContext& context,
                                                const TwoViewHints& hints) {
  const MatchedBearings bearings{bearings_a, bearings_b, max_error_rad, context.seed};
  const PairView view{pair, bearings, options, context, hints};
  const auto num_putative = static_cast<uint32_t>(matches.size());
  const MatchesByMotion split = SplitByMotion(bearings_a, bearings_b, matches, max_error_rad);
  if (static_cast<double>(split.fixed.size()) >= kNotedShare * static_cast<double>(num_putative)) {
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry moved, view.BelowSky(split.moved));
    moved.num_putative = num_putative;
    const bool is_scene = moved.kind != TwoViewKind::kNone && hints.Allow(moved);
    if (is_scene && view.IsTheScene(moved, split)) return moved;
  }
  ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry geometry, view.BelowSky(matches));
  ORBWEAVE_ASSIGN_OR_RETURN(geometry, view.BesidesPlane(std::move(geometry), matches));
  if (ShowsTheCarrierAlone(geometry, max_error_rad) || !hints.Allow(geometry)) {
    return TwoViewGeometry{.pair = pair, .num_putative = num_putative};
  }
  return geometry;
}

}  // namespace orbweave
