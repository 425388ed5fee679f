// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/stages/match_image_pair.h"

#include <algorithm>

namespace orbweave {
namespace {

/// Equation (8) for a pair: the coarser of the two panoramas sets the angle.
double MaxErrorRad(const PairSide& a, const PairSide& b, double max_error_px) {
  return std::max(a.features.camera.AngleFromPixels(max_error_px),
                  b.features.camera.AngleFromPixels(max_error_px));
}

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
  const double max_error_rad = MaxErrorRad(a, b, two_view_options.max_error_px);
  const auto verify = [&](const std::vector<FeatureMatch>& matches) {
    return EstimateTwoView(
        pair, a.bearings, b.bearings, matches, max_error_rad, two_view_options, context);
  };
  if (!given.empty()) return verify(given);
  ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry geometry,
                            verify(MatchDescriptors(a.features, b.features, match_options)));
  const bool has_epipolar_planes =
      geometry.kind == TwoViewKind::kGeneral || geometry.kind == TwoViewKind::kPlanar;
  if (!match_options.guided || !has_epipolar_planes) return geometry;

  const std::vector<FeatureMatch> guided =
      MatchGuided(a.features, b.features, geometry.b_from_a, max_error_rad, match_options);
  ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry guided_geometry, verify(guided));
  return guided_geometry.inliers.size() > geometry.inliers.size() ? guided_geometry : geometry;
}

}  // namespace orbweave
