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
#include "core/estimators/match_evidence.h"
#include "core/estimators/matches_besides_plane.h"
#include "core/estimators/resolve_cheirality.h"
#include "core/estimators/sky_drift.h"
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
constexpr double kStanding = 0.9;     // of what is far and high: no clouds, then
constexpr int kSkyRounds = 3;
constexpr double kFarBaselines = 5.0;  // houses lie within five steps of 5 m across a street
// Clouds drift by half a degree a second: in the ten that neighbours are apart at most.
constexpr double kMaxDrift_rad = 0.087;
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
                                             std::span<const Vector3d> bearings_a,
                                             std::span<const Vector3d> bearings_b,
                                             std::span<const FeatureMatch> matches,
                                             const TwoViewHints& hints,
                                             double max_error_rad,
                                             const TwoViewOptions& options,
                                             const StageContext& context) {
  TwoViewGeometry geometry{.pair = pair, .num_putative = static_cast<uint32_t>(matches.size())};
  if (matches.size() < static_cast<size_t>(options.min_inliers)) return geometry;
  const BearingPairs pairs = ArrangePairs(bearings_a, bearings_b, matches, context.seed);
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
  std::span<const Vector3d> bearings_a;
  std::span<const Vector3d> bearings_b;
  double max_error_rad = 0.0;
  const TwoViewOptions& options;
  const StageContext& context;
  const TwoViewHints& hints;  ///< the order is that of all matches that are passed

  [[nodiscard]] absl::StatusOr<TwoViewGeometry> From(std::span<const FeatureMatch> matches) const {
    return EstimateFrom(
        pair, bearings_a, bearings_b, matches, hints, max_error_rad, options, context);
  }

  /// Whether what has moved is the scene, and what has not the carrier: it covers more of the
  /// sphere; or it lies all around and has a pose of its own, in which most of what is fixed would
  /// be elsewhere. A roof and the edge of what it hides cover more than the horizon does.
  [[nodiscard]] bool IsTheScene(const TwoViewGeometry& moved, const MatchesByMotion& split) const {
    if (moved.spread > split.fixed_spread) return true;
    const auto explained = static_cast<double>(Agreeing(Arranged(split.fixed), moved).size());
    return IsAllAround(moved, bearings_a) &&
           explained < kSameScene * static_cast<double>(split.fixed.size());
  }

  /// The geometry of the scene where that of all matches is the sky's; none where the sky alone
  /// matches.
  [[nodiscard]] absl::StatusOr<TwoViewGeometry> BelowSky(
      std::span<const FeatureMatch> matches) const {
    ORBWEAVE_ASSIGN_OR_RETURN(const TwoViewGeometry all, From(matches));
    if (all.kind == TwoViewKind::kNone) return all;
    const std::vector<FeatureMatch> sky = SkyOf(all);
    if (static_cast<double>(sky.size()) < kMostlySky * static_cast<double>(all.inliers.size()))
      return DropSky(all, matches);
    std::vector<FeatureMatch> rest;
    std::ranges::copy_if(matches, std::back_inserter(rest), [&](const FeatureMatch& match) {
      return !std::ranges::binary_search(sky, match);
    });
    const double evidence_of_all =
        EvidenceOf(Arranged(rest), all.b_from_a, max_error_rad, hints.Sample()).log10_false_alarms;
    ORBWEAVE_ASSIGN_OR_RETURN(const TwoViewGeometry scene, From(rest));
    const bool is_scene =
        scene.kind != TwoViewKind::kNone && !ShowsTheCarrierAlone(scene, max_error_rad);
    if (is_scene && kAsEvident * scene.log10_false_alarms < evidence_of_all)
      return DropSky(Extended(scene, matches), matches);
    const auto in_scene = static_cast<double>(Agreeing(Arranged(rest), all).size());
    if (evidence_of_all <= options.max_log10_false_alarms || !SeesTheGround() ||
        in_scene >= std::max(kFewInScene, kSameScene * static_cast<double>(rest.size())))
      return DropSky(all, matches);
    return TwoViewGeometry{.pair = pair, .num_putative = all.num_putative};
  }

  /// Another geometry where one plane carries `all`, and what matches elsewhere hardly agrees with
  /// `all` and clearly with that one (MatchesBesidesPlane).
  [[nodiscard]] absl::StatusOr<TwoViewGeometry> BesidesPlane(
      TwoViewGeometry all, std::span<const FeatureMatch> matches) const {
    if (all.kind == TwoViewKind::kNone || all.kind == TwoViewKind::kPureRotation) return all;
    ORBWEAVE_ASSIGN_OR_RETURN(
        const std::optional<std::vector<FeatureMatch>> elsewhere,
        MatchesBesidesPlane(bearings_a, bearings_b, matches, all, max_error_rad, context));
    if (!elsewhere) return all;
    ORBWEAVE_ASSIGN_OR_RETURN(const TwoViewGeometry other, BelowSky(*elsewhere));
    if (other.kind != TwoViewKind::kGeneral || !MayBeAliases(all.b_from_a, other.b_from_a))
      return all;
    const double of_all = EvidenceBelowSky(*elsewhere, all);
    const double of_other = EvidenceBelowSky(*elsewhere, other);
    if (of_all <= kHardly * of_other || of_other > of_all - kClearlyMore) return all;
    return DropSky(Extended(other, matches), matches);
  }

 private:
  /// High, and moved as little as clouds do.
  [[nodiscard]] bool MayBeSky(const FeatureMatch& match, const TwoViewGeometry& geometry) const {
    const Vector3d& a = bearings_a[match.a];
    const Vector3d& b = bearings_b[match.b];
    return IsEitherHigh(a, b) && AngleBetween(geometry.b_from_a.rotation * a, b) < kMaxDrift_rad;
  }

  [[nodiscard]] double EvidenceBelowSky(std::span<const FeatureMatch> matches,
                                        const TwoViewGeometry& geometry) const {
    std::vector<FeatureMatch> scene;
    std::ranges::copy_if(matches, std::back_inserter(scene), [&](const FeatureMatch& match) {
      return !MayBeSky(match, geometry);
    });
    return EvidenceOf(Arranged(scene), geometry.b_from_a, max_error_rad, hints.Sample())
        .log10_false_alarms;
  }

  [[nodiscard]] BearingPairs Arranged(std::span<const FeatureMatch> matches) const {
    return ArrangePairs(bearings_a, bearings_b, matches, context.seed);
  }

  /// Inliers that are high up and too far away for the houses around, sorted.
  [[nodiscard]] std::vector<FeatureMatch> SkyOf(const TwoViewGeometry& geometry) const {
    if (geometry.kind == TwoViewKind::kPureRotation)
      return SplitByHeight(bearings_a, bearings_b, geometry.inliers).high;
    std::vector<FeatureMatch> sky;
    for (const FeatureMatch& match : geometry.inliers) {
      const Vector3d& a = bearings_a[match.a];
      const Vector3d& b = bearings_b[match.b];
      if (IsEitherHigh(a, b) && InverseDepth(a, b, geometry.b_from_a) < 1.0 / kFarBaselines)
        sky.push_back(match);
    }
    return sky;
  }

  /// Whether both panoramas have features below, so that a scene in common would have matches
  /// there.
  [[nodiscard]] bool SeesTheGround() const {
    return std::ranges::all_of(std::array{bearings_a, bearings_b}, [](const auto& bearings) {
      const auto high = static_cast<double>(std::ranges::count_if(bearings, IsHigh));
      return high <= (1.0 - kLowFeatures) * static_cast<double>(bearings.size());
    });
  }

  /// With all matches that agree with the geometry of some.
  [[nodiscard]] TwoViewGeometry Extended(TwoViewGeometry geometry,
                                         std::span<const FeatureMatch> matches) const {
    geometry.num_putative = static_cast<uint32_t>(matches.size());
    const BearingPairs pairs = Arranged(matches);
    const std::vector<uint32_t> inliers = Agreeing(pairs, geometry);
    SetInliers(Subset(pairs, inliers), matches, geometry);
    return geometry;
  }

  [[nodiscard]] std::vector<uint32_t> Agreeing(const BearingPairs& pairs,
                                               const TwoViewGeometry& geometry) const {
    const Rigid3& pose = geometry.b_from_a;
    if (geometry.kind != TwoViewKind::kPureRotation) return InliersOf(pairs, pose, max_error_rad);
    std::vector<uint32_t> inliers;
    for (uint32_t i = 0; i < pairs.Size(); ++i) {
      if (IsWithinAngle(pose.rotation * pairs.A(i), pairs.B(i), max_error_rad))
        inliers.push_back(i);
    }
    return inliers;
  }

  /// Whether what is high and far stands still, as towers do: of all `putative` matches that are,
  /// nearly all agree with the pose of the scene, while clouds drift off most epipolar planes; and
  /// they have not turned by what is less than the error that agreeing allows.
  [[nodiscard]] bool StandsStill(std::span<const FeatureMatch> putative,
                                 const TwoViewGeometry& scene,
                                 const BearingPairs& of_scene) const {
    std::vector<FeatureMatch> matches;
    std::ranges::copy_if(putative, std::back_inserter(matches), [&](const FeatureMatch& match) {
      return MayBeSky(match, scene);
    });
    const BearingPairs far = Arranged(matches);
    return static_cast<double>(Agreeing(far, scene).size()) >=
               kStanding * static_cast<double>(far.Size()) &&
           !MeasureSkyDrift(far, of_scene, scene.b_from_a, max_error_rad).IsClear();
  }

  /// What may not be sky of those that agree with a pose.
  [[nodiscard]] std::vector<uint32_t> Low(const BearingPairs& pairs, const Rigid3& b_from_a) const {
    return WithoutSky(pairs, InliersOf(pairs, b_from_a, max_error_rad), b_from_a, max_error_rad);
  }

  /// The pose of inliers that may not be sky, and those of that pose, in turns until no more come:
  /// the sky has drawn both along, so that fewer agree at first.
  [[nodiscard]] ResolvedPose BelowSkyOf(const BearingPairs& pairs, const Rigid3& b_from_a) const {
    ResolvedPose below{b_from_a, Low(pairs, b_from_a)};
    for (int round = 0; round < kSkyRounds && !below.inliers.empty(); ++round) {
      const Rigid3 pose = RefinePose(pairs, below.inliers, below.b_from_a, max_error_rad);
      std::vector<uint32_t> inliers = Low(pairs, pose);
      if (round > 0 && inliers.size() <= below.inliers.size()) break;
      below = {pose, std::move(inliers)};
    }
    return below;
  }

  /// Without what is far and high, which draws the pose along when it drifts. `putative`: of which
  /// the geometry was found.
  [[nodiscard]] TwoViewGeometry DropSky(TwoViewGeometry geometry,
                                        std::span<const FeatureMatch> putative) const {
    if (geometry.kind == TwoViewKind::kNone || geometry.kind == TwoViewKind::kPureRotation)
      return geometry;
    const BearingPairs pairs = Arranged(putative);
    const ResolvedPose below = BelowSkyOf(pairs, geometry.b_from_a);
    const auto most = (1.0 - kNotedShare) * static_cast<double>(geometry.inliers.size());
    if (below.inliers.size() < static_cast<size_t>(options.min_inliers) ||
        static_cast<double>(below.inliers.size()) > most) {
      return geometry;
    }
    const BearingPairs inliers = Subset(pairs, below.inliers);
    TwoViewGeometry scene = geometry;
    scene.b_from_a = below.b_from_a;
    if (StandsStill(putative, scene, inliers)) return geometry;
    SetInliers(inliers, putative, scene);
    return scene;
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
  const PairView view{pair, bearings_a, bearings_b, max_error_rad, options, context, hints};
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
