// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/match_images/match_image_pair.h"

#include <algorithm>

#include "core/estimators/estimate_two_view.h"
#include "core/features/find_nearest_two.h"
#include "core/features/match_against_decoys.h"
#include "core/features/match_descriptors.h"

namespace orbweave {
namespace {

/// Ten pairs of images of different places have one geometry as good as this: worth a second look.
constexpr double kWorthALook = -1.0;
/// Streets that look alike fill wrong planes a little better than decoys do: a pair that rests on
/// predictions needs a hundred times the evidence.
constexpr double kDoubtOfPredictions = 2.0;

/// Equation (8) for a pair: the coarser of the two panoramas sets the angle.
double MaxErrorRad(const PairSide& a, const PairSide& b, double max_error_px) {
  return std::max(a.features.camera.AngleFromPixels(max_error_px),
                  b.features.camera.AngleFromPixels(max_error_px));
}

bool HasEpipolarPlanes(const TwoViewGeometry& geometry) {
  return geometry.kind == TwoViewKind::kGeneral || geometry.kind == TwoViewKind::kPlanar;
}

/// The rungs of the ladder for one pair.
struct PairMatcher {
  ImagePair pair{};
  const PairSide& a;
  const PairSide& b;
  const MatchOptions& match_options;
  const TwoViewOptions& two_view_options;
  const StageContext& context;

  [[nodiscard]] double MaxError() const { return MaxErrorRad(a, b, two_view_options.max_error_px); }

  [[nodiscard]] absl::StatusOr<TwoViewGeometry> Verify(const std::vector<FeatureMatch>& matches,
                                                       const TwoViewOptions& options) const {
    return EstimateTwoView(pair, a.bearings, b.bearings, matches, MaxError(), options, context);
  }

  /// The geometry of the matches with the most evidence, however little, of those rungs that need
  /// be climbed.
  [[nodiscard]] absl::StatusOr<TwoViewGeometry> Climb(
      const std::vector<FeatureMatch>& matches) const {
    TwoViewOptions any = two_view_options;
    any.max_log10_false_alarms = std::max(any.max_log10_false_alarms, kWorthALook);
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry best, Verify(matches, any));
    best.rung = MatchRung::kDescriptors;
    if (IsEvident(best) || any.solver != TwoViewSolver::kFivePoint) return best;
    any.solver = TwoViewSolver::kUprightThreePoint;
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry upright, Verify(matches, any));
    upright.rung = MatchRung::kUpright;
    const bool is_better =
        upright.kind != TwoViewKind::kNone &&
        (best.kind == TwoViewKind::kNone || upright.log10_false_alarms < best.log10_false_alarms);
    return is_better ? upright : best;
  }

  /// The geometry with what it predicts, or none where there is no evidence.
  [[nodiscard]] absl::StatusOr<TwoViewGeometry> Confirm(const TwoViewGeometry& geometry,
                                                        const NearestTwoBothWays& nearest) const {
    const TwoViewGeometry nothing{.pair = pair, .num_putative = geometry.num_putative};
    if (!HasEpipolarPlanes(geometry) || !match_options.guided)
      return IsEvident(geometry) ? geometry : nothing;
    const PredictedMatches predicted = MatchAgainstDecoys(a.features,
                                                          b.features,
                                                          geometry.b_from_a,
                                                          MaxError(),
                                                          nearest,
                                                          geometry.inliers,
                                                          match_options);
    TwoViewGeometry confirmed = geometry;
    confirmed.log10_false_alarms += predicted.log10_chance;
    if (!IsEvident(geometry)) {
      confirmed.rung = MatchRung::kGuided;
      confirmed.log10_false_alarms += kDoubtOfPredictions;
      if (!IsEvident(confirmed)) return nothing;
    }
    ORBWEAVE_ASSIGN_OR_RETURN(const TwoViewGeometry grown,
                              Verify(predicted.matches, two_view_options));
    if (grown.inliers.size() <= confirmed.inliers.size()) return confirmed;
    confirmed.kind = grown.kind;
    confirmed.b_from_a = grown.b_from_a;
    confirmed.inliers = grown.inliers;
    confirmed.median_angle_rad = grown.median_angle_rad;
    confirmed.spread = grown.spread;
    return confirmed;
  }

  [[nodiscard]] bool IsEvident(const TwoViewGeometry& geometry) const {
    return geometry.kind != TwoViewKind::kNone &&
           geometry.log10_false_alarms <= two_view_options.max_log10_false_alarms;
  }
};

}  // namespace

std::vector<Eigen::Vector3d> BearingsOf(const Features& features) {
  std::vector<Eigen::Vector3d> bearings(features.size());
  for (FeatureIndex i = 0; i < bearings.size(); ++i) bearings[i] = features.Bearing(i);
  return bearings;
}

absl::StatusOr<TwoViewGeometry> MatchImagePair(ImagePair pair,
                                               const PairSide& a,
                                               const PairSide& b,
                                               const std::vector<FeatureMatch>& given,
                                               const MatchOptions& match_options,
                                               const TwoViewOptions& two_view_options,
                                               const StageContext& context) {
  const PairMatcher matcher{pair, a, b, match_options, two_view_options, context};
  if (!given.empty()) return matcher.Verify(given, two_view_options);
  if (a.features.descriptors.empty() || b.features.descriptors.empty()) {
    return TwoViewGeometry{.pair = pair};
  }
  const NearestTwoBothWays nearest = FindNearestTwo(a.features.descriptors, b.features.descriptors);
  ORBWEAVE_ASSIGN_OR_RETURN(const TwoViewGeometry geometry,
                            matcher.Climb(AcceptNearest(nearest, match_options)));
  return matcher.Confirm(geometry, nearest);
}

}  // namespace orbweave
