// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/match_images/match_image_pair.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "core/estimators/bearing_pairs.h"
#include "core/estimators/estimate_two_view.h"
#include "core/estimators/find_rival_direction.h"
#include "core/estimators/grow_two_view.h"
#include "core/estimators/match_evidence.h"
#include "core/estimators/two_view_inliers.h"
#include "core/features/accept_matches.h"
#include "core/features/growing_nearest.h"
#include "core/features/match_against_decoys.h"
#include "core/features/match_descriptors.h"
#include "core/features/match_facades.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

/// Ten pairs of images of different places have one geometry as good as this: worth a second look.
constexpr double kWorthALook = -1.0;
/// Streets that look alike fill wrong planes a little better than decoys do: a pair that rests on
/// predictions needs a hundred times the evidence.
constexpr double kDoubtOfPredictions = 2.0;
/// Of the largest features' matches that fit no geometry found: those of facades that repeat had
/// -22 to -190, those of other pairs -10 at most.
constexpr double kRival = -12.0;
/// Of the largest features of a town, geometries with this much evidence were those of all features
/// where they predicted new matches that planes of wrong ones find once in 10^12; of others, with
/// up to 10^-52, one in ten was not, and these predicted what wrong planes find once in 10^6.
constexpr double kLikely = -40.0;
constexpr double kSurelyPredicted = -12.0;
/// Of the largest features' matches: of two geometries that fewer agree with each, features of all
/// scales choose.
constexpr double kLikelyShare = 1.0 / 3.0;
/// Steps of the ladder of scales: the features taken together grow by so much each time.
constexpr double kGrowth = 2.5;
/// Planes that move by this share of their width leave matches out: they are looked for again.
constexpr double kMoved = 0.5;
constexpr int kMaxRounds = 3;
/// Six degrees. Of 2,452 right pairs of a town's panoramas, which a program levelled, 119 leaned
/// by more, and 93 of 203 wrong ones.
constexpr double kStandsAlike_rad = 0.105;
/// Of the evidence for cameras that lean, that those which stand alike must have to be taken. In
/// that town 42 were: of 23 wrong pairs 19 came nearer to what is right, by up to 44 degrees, and
/// of 19 right ones, that is to six degrees, none is off by more than ten.
constexpr double kAsEvident = 0.8;

/// Equation (8) for a pair: the coarser of the two panoramas sets the angle.
double MaxErrorRad(const PairSide& a, const PairSide& b, double max_error_px) {
  return std::max(a.features.camera.AngleFromPixels(max_error_px),
                  b.features.camera.AngleFromPixels(max_error_px));
}

/// Inliers that have clearly moved by more than a rotation.
uint32_t CountMoved(const TwoViewGeometry& geometry,
                    const PairSide& a,
                    const PairSide& b,
                    double max_error_rad) {
  const auto moved = std::ranges::count_if(geometry.inliers, [&](const FeatureMatch& match) {
    return HasClearlyMoved(
        geometry.b_from_a.rotation, a.bearings[match.a], b.bearings[match.b], max_error_rad);
  });
  return static_cast<uint32_t>(moved);
}

/// Of all matches, what stands still with the carrier among them.
double ShareOf(const TwoViewGeometry& geometry) {
  return static_cast<double>(geometry.inliers.size()) / geometry.num_putative;
}

/// The rungs of the ladder for one pair.
struct PairMatcher {
  ImagePair pair{};
  const PairSide& a;
  const PairSide& b;
  const MatchOptions& match_options;
  const TwoViewOptions& two_view_options;
  const StageContext& context;
  const TwoViewHints& hints;
  std::vector<RatedMatch> of_facades{};  ///< beside those of the panoramas themselves

  [[nodiscard]] double MaxError() const { return MaxErrorRad(a, b, two_view_options.max_error_px); }

  [[nodiscard]] absl::StatusOr<TwoViewGeometry> Verify(const std::vector<FeatureMatch>& best_first,
                                                       const TwoViewOptions& options) const {
    return EstimateTwoView(
        pair, a.bearings, b.bearings, best_first, MaxError(), options, context, hints);
  }

  /// The geometry that the largest features show beyond doubt, by themselves or by what it predicts
  /// of all features, grown over that; they are compared as far as that takes. None where it takes
  /// all.
  [[nodiscard]] absl::StatusOr<TwoViewGeometry> FromLargest(GrowingNearest& nearest) const {
    const TwoViewGeometry nothing{.pair = pair};
    if (match_options.largest_first == 0 || !match_options.guided) return nothing;
    TwoViewOptions likely = two_view_options;
    likely.max_log10_false_alarms = std::min(likely.max_log10_false_alarms, kLikely);
    likely.min_inlier_share = std::max(likely.min_inlier_share, kLikelyShare);
    for (double count = match_options.largest_first;; count *= kGrowth) {
      nearest.GrowTo(static_cast<size_t>(count));
      if (nearest.HasAll()) return nothing;
      const std::vector<FeatureMatch> matches = BestFirst(Rated(nearest.Nearest()));
      ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry geometry, Verify(matches, likely));
      geometry.rung = MatchRung::kLargest;
      // More may show what is off a plane, that the camera moved, or which direction is right.
      if (geometry.kind != TwoViewKind::kGeneral || !ShowsTranslation(geometry) ||
          HasRival(geometry, matches))
        continue;
      const bool is_sure = geometry.log10_false_alarms <= NoDoubt();
      if (!is_sure && ShareOf(geometry) < kLikelyShare) continue;
      const PredictedMatches predicted = Predict(geometry, nullptr, !is_sure);
      if (is_sure || predicted.log10_chance <= kSurelyPredicted)
        return Grow(geometry, predicted.matches, nullptr);
    }
  }

  /// Evidence of largest features that needs nothing else, whatever less the options ask for.
  [[nodiscard]] double NoDoubt() const {
    return std::min(two_view_options.max_log10_false_alarms, kNoDoubt);
  }

  /// What the geometry predicts; whether that is more than chance is asked where it is in doubt.
  [[nodiscard]] PredictedMatches Predict(const TwoViewGeometry& geometry,
                                         const NearestTwoBothWays* nearest,
                                         bool is_in_doubt) const {
    std::optional<std::span<const FeatureMatch>> known;
    if (is_in_doubt) known = geometry.inliers;
    PredictedMatches predicted =
        MatchAgainstDecoys(a, b, geometry.b_from_a, MaxError(), nearest, known, match_options);
    // Theirs are the last features of both, so that all are in order.
    predicted.matches = WithFacades(std::move(predicted.matches));
    return predicted;
  }

  /// Whether as many inliers as a geometry needs have clearly moved by more than a rotation: where
  /// all are far away, or the camera hardly moved, all features may show more. How far most have
  /// moved says nothing: the largest features of a street are those of hills and clouds.
  [[nodiscard]] bool ShowsTranslation(const TwoViewGeometry& geometry) const {
    return CountMoved(geometry, a, b, MaxError()) >=
           static_cast<uint32_t>(two_view_options.min_inliers);
  }

  /// Whether what does not fit speaks for another direction: windows that repeat, or a vehicle.
  [[nodiscard]] bool HasRival(const TwoViewGeometry& geometry,
                              const std::vector<FeatureMatch>& matches) const {
    return FindRivalDirection(a.bearings, b.bearings, matches, geometry, MaxError(), context.seed)
               .log10_false_alarms <= kRival;
  }

  [[nodiscard]] std::vector<RatedMatch> Rated(const NearestTwoBothWays& nearest) const {
    return RateMatches(AcceptNearest(nearest, match_options), nearest);
  }

  /// The geometry of the matches with the most evidence, however little, of those rungs that need
  /// be climbed.
  [[nodiscard]] absl::StatusOr<TwoViewGeometry> Climb(std::vector<RatedMatch> rated) const {
    const std::vector<FeatureMatch> matches = BestFirst(std::move(rated));
    TwoViewOptions any = two_view_options;
    any.max_log10_false_alarms = std::max(any.max_log10_false_alarms, kWorthALook);
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry best, Verify(matches, any));
    best.rung = MatchRung::kDescriptors;
    const bool is_settled = IsEvident(best) && StandsAlike(best);
    if (hints.predicted || is_settled || any.solver != TwoViewSolver::kFivePoint) return best;
    any.solver = TwoViewSolver::kUprightThreePoint;
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry upright, Verify(matches, any));
    upright.rung = MatchRung::kUpright;
    const bool leans_less = !StandsAlike(best) && StandsAlike(upright);
    const double enough = best.log10_false_alarms * (leans_less ? kAsEvident : 1.0);
    const bool is_better = upright.kind != TwoViewKind::kNone &&
                           (best.kind == TwoViewKind::kNone || upright.log10_false_alarms < enough);
    return is_better ? upright : best;
  }

  /// Whether both cameras have one vertical. Matches of one facade, and clouds with it, fit a
  /// camera that leans and stands elsewhere as well as the one that took the picture.
  [[nodiscard]] static bool StandsAlike(const TwoViewGeometry& geometry) {
    const Eigen::Vector3d down = Eigen::Vector3d::UnitY();
    return AngleBetween(geometry.b_from_a.rotation * down, down) <= kStandsAlike_rad;
  }

  [[nodiscard]] std::vector<FeatureMatch> WithFacades(std::vector<FeatureMatch> matches) const {
    for (const RatedMatch& rated : of_facades) matches.push_back(rated.match);
    return matches;
  }

  /// The geometry with what it predicts, or none where there is no evidence.
  [[nodiscard]] absl::StatusOr<TwoViewGeometry> Confirm(const TwoViewGeometry& geometry,
                                                        const NearestTwoBothWays* nearest) const {
    const TwoViewGeometry nothing{.pair = pair, .num_putative = geometry.num_putative};
    if (!HasBaseline(geometry.kind) || !match_options.guided)
      return IsEvident(geometry) ? geometry : nothing;
    const PredictedMatches predicted = Predict(geometry, nearest, !IsEvident(geometry));
    TwoViewGeometry confirmed = geometry;
    confirmed.log10_false_alarms += predicted.log10_chance;
    if (!IsEvident(geometry)) {
      confirmed.rung = MatchRung::kGuided;
      confirmed.log10_false_alarms += kDoubtOfPredictions;
      if (!IsEvident(confirmed)) return nothing;
    }
    return Grow(confirmed, predicted.matches, nearest);
  }

  /// The geometry refined over what it predicts, which is looked for again as long as that moves
  /// its planes.
  [[nodiscard]] TwoViewGeometry Grow(TwoViewGeometry geometry,
                                     std::vector<FeatureMatch> predicted,
                                     const NearestTwoBothWays* nearest) const {
    for (int round = 1;; ++round) {
      const Rigid3 before = geometry.b_from_a;
      geometry = GrowTwoView(geometry, a.bearings, b.bearings, predicted, MaxError(), context.seed);
      if (round == kMaxRounds || !HasMoved(before, geometry.b_from_a)) return geometry;
      predicted = Predict(geometry, nearest, false).matches;
    }
  }

  [[nodiscard]] bool HasMoved(const Rigid3& before, const Rigid3& after) const {
    const double turned = RotationAngle(before.rotation.conjugate() * after.rotation);
    return turned + AngleBetween(before.translation, after.translation) > kMoved * MaxError();
  }

  /// The geometry of `matches` of the panoramas themselves and of facade views together, or none
  /// where these add nothing. A panorama shows the same window further on as it shows it here, and
  /// the window itself tilted, so that look-alikes match better than what is right; facade views
  /// show all of them alike. So do houses of other streets that look the same: matches of the
  /// panoramas themselves have to bear the pose out.
  [[nodiscard]] absl::StatusOr<TwoViewGeometry> ByFacades(const std::vector<RatedMatch>& matches,
                                                          const NearestTwoBothWays& nearest) const {
    const TwoViewGeometry nothing{.pair = pair};
    PairMatcher matcher = *this;
    matcher.of_facades = MatchFacades(a, b, MaxError(), match_options);
    if (matcher.of_facades.empty()) return nothing;
    std::vector<RatedMatch> all = matches;
    std::ranges::copy(matcher.of_facades, std::back_inserter(all));
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry geometry, matcher.Climb(std::move(all)));
    if (geometry.kind == TwoViewKind::kNone || !IsBorneOut(geometry, matches)) return nothing;
    geometry.rung = MatchRung::kFacades;
    return matcher.Confirm(geometry, &nearest);
  }

  [[nodiscard]] bool IsBorneOut(const TwoViewGeometry& geometry,
                                const std::vector<RatedMatch>& rated) const {
    std::vector<FeatureMatch> matches;
    for (const RatedMatch& one : rated) matches.push_back(one.match);
    return EvidenceOf(ArrangePairs(a.bearings, b.bearings, matches, context.seed),
                      geometry.b_from_a,
                      MaxError(),
                      hints.Sample())
               .log10_false_alarms <= kWorthALook;
  }

  /// With a prediction that is the rung, however the geometry was found; none where growth has led
  /// away from it.
  [[nodiscard]] TwoViewGeometry AsPredicted(TwoViewGeometry geometry) const {
    if (!hints.Allow(geometry)) return {.pair = pair, .num_putative = geometry.num_putative};
    if (hints.predicted) geometry.rung = MatchRung::kPropagated;
    return geometry;
  }

  [[nodiscard]] bool IsEvident(const TwoViewGeometry& geometry) const {
    return geometry.kind != TwoViewKind::kNone &&
           geometry.log10_false_alarms <= two_view_options.max_log10_false_alarms;
  }
};

}  // namespace

absl::StatusOr<TwoViewGeometry> MatchImagePair(ImagePair pair,
                                               const PairSide& a,
                                               const PairSide& b,
                                               const GivenPair& given,
                                               const MatchOptions& match_options,
                                               const TwoViewOptions& two_view_options,
                                               const StageContext& context) {
  const TwoViewHints hints{.order = MatchOrder::kBestFirst, .predicted = given.predicted};
  const PairMatcher matcher{pair, a, b, match_options, two_view_options, context, hints};
  if (!given.matches.empty()) {
    return EstimateTwoView(
        pair, a.bearings, b.bearings, given.matches, matcher.MaxError(), two_view_options, context);
  }
  if (a.features.descriptors.empty() || b.features.descriptors.empty()) {
    return TwoViewGeometry{.pair = pair};
  }
  GrowingNearest growing(a, b);
  const bool have_facades = a.HasFacades() && b.HasFacades();
  if (!have_facades && !given.predicted) {
    ORBWEAVE_ASSIGN_OR_RETURN(const TwoViewGeometry first, matcher.FromLargest(growing));
    if (first.kind != TwoViewKind::kNone) return first;
  }
  growing.GrowTo(std::max(a.num_plain, b.num_plain));
  const NearestTwoBothWays nearest = growing.Nearest();
  const std::vector<RatedMatch> matches = matcher.Rated(nearest);
  if (have_facades) {
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry geometry, matcher.ByFacades(matches, nearest));
    if (geometry.kind != TwoViewKind::kNone) return matcher.AsPredicted(std::move(geometry));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const TwoViewGeometry geometry, matcher.Climb(matches));
  ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry confirmed, matcher.Confirm(geometry, &nearest));
  return matcher.AsPredicted(std::move(confirmed));
}

MatchedPair WithoutMatches(const TwoViewGeometry& geometry,
                           const PairSide& a,
                           const PairSide& b,
                           const TwoViewOptions& two_view_options) {
  return {.pair = geometry.pair,
          .kind = geometry.kind,
          .num_moved = CountMoved(geometry, a, b, MaxErrorRad(a, b, two_view_options.max_error_px)),
          .log10_false_alarms = geometry.log10_false_alarms,
          .rung = geometry.rung,
          .b_from_a = geometry.b_from_a};
}

}  // namespace orbweave
