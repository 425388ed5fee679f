// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/match_images/inspect_pair.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "core/base/quantile.h"
#include "core/estimators/estimate_two_view.h"
#include "core/features/match_descriptors.h"
#include "core/geometry/epipolar.h"
#include "core/geometry/rotation.h"
#include "core/geometry/sphere_cells.h"
#include "core/scene/places_in_drives.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// The smallest support that more than one solver's sample can have.
constexpr int kFewestInliers = 8;

/// The best geometry of the putative matches, however few support it.
absl::StatusOr<TwoViewGeometry> BestGeometry(ImagePair pair,
                                             const PairSide& a,
                                             const PairSide& b,
                                             const std::vector<FeatureMatch>& putative,
                                             TwoViewOptions options,
                                             const StageContext& context) {
  options.min_inliers = kFewestInliers;
  options.min_inlier_share = 0.0;
  options.max_log10_false_alarms = 1000.0;
  const double max_error_rad = std::max(a.features.camera.AngleFromPixels(options.max_error_px),
                                        b.features.camera.AngleFromPixels(options.max_error_px));
  return EstimateTwoView(pair, a.bearings, b.bearings, putative, max_error_rad, options, context);
}

double InlierResidual_rad(const TwoViewGeometry& geometry, const Vector3d& a, const Vector3d& b) {
  if (geometry.kind == TwoViewKind::kPureRotation)
    return AngleBetween(geometry.b_from_a.rotation * a, b);
  return SymmetricEpipolarAngle(geometry.b_from_a, a, b);
}

void MeasureInliers(const PairSide& a, const PairSide& b, PairInspection& inspection) {
  const TwoViewGeometry& geometry = inspection.geometry;
  if (geometry.inliers.empty()) return;
  std::vector<double> residuals_px;
  std::vector<Vector3d> in_b;
  for (const FeatureMatch& match : geometry.inliers) {
    const Vector3d& ray_a = a.bearings[match.a];
    const Vector3d& ray_b = b.bearings[match.b];
    residuals_px.push_back(
        a.features.camera.PixelsFromAngle(InlierResidual_rad(geometry, ray_a, ray_b)));
    in_b.push_back(ray_b);
    if (std::ranges::binary_search(inspection.putative, match)) continue;
    ++(match.a >= a.num_plain ? inspection.num_on_facades : inspection.num_guided);
  }
  inspection.residual_px_median = UpperMedian(std::move(residuals_px));
  inspection.spread_in_b = SphereSpread(in_b);
}

/// Whether candidates are matched in rounds, some perhaps not at all.
bool AreHeldBack(const ImageManifest& manifest, const PairOptions& options) {
  return options.first_neighbours > 0 &&
         manifest.images.size() >= static_cast<size_t>(options.exhaustive_below);
}

std::string Metres(double metres) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f m", metres);
  return text;
}

}  // namespace

std::vector<FeatureMatch> PairInspection::Outliers() const {
  std::vector<FeatureMatch> outliers;
  std::set_difference(putative.begin(),
                      putative.end(),
                      geometry.inliers.begin(),
                      geometry.inliers.end(),
                      std::back_inserter(outliers));
  return outliers;
}

absl::StatusOr<PairInspection> InspectPair(ImagePair pair,
                                           const PairSide& a,
                                           const PairSide& b,
                                           const std::vector<FeatureMatch>& given,
                                           const std::optional<TwoViewGeometry>& verified,
                                           const MatchOptions& match_options,
                                           const TwoViewOptions& two_view_options,
                                           const StageContext& context) {
  PairInspection inspection;
  inspection.putative =
      given.empty() ? MatchDescriptors(a.features, b.features, match_options) : given;
  std::sort(inspection.putative.begin(), inspection.putative.end());
  if (verified) {
    inspection.geometry = *verified;
  } else {
    ORBWEAVE_ASSIGN_OR_RETURN(
        inspection.geometry,
        MatchImagePair(pair, a, b, {given}, match_options, two_view_options, context));
  }
  inspection.verdict = PairVerdict::kVerified;
  if (inspection.geometry.kind == TwoViewKind::kNone) {
    ORBWEAVE_ASSIGN_OR_RETURN(
        inspection.geometry,
        BestGeometry(pair, a, b, inspection.putative, two_view_options, context));
    inspection.verdict = inspection.geometry.kind == TwoViewKind::kNone ? PairVerdict::kNothing
                                                                        : PairVerdict::kRejected;
  }
  MeasureInliers(a, b, inspection);
  return inspection;
}

std::string WhyNotSelected(const ImageManifest& manifest,
                           ImagePair pair,
                           const PairOptions& options) {
  const ImageRecord& a = manifest.At(pair.a);
  const ImageRecord& b = manifest.At(pair.b);
  std::string why = "of two drives, which no sequence joins";
  const std::optional<uint32_t> steps = PlacesInDrives(manifest).StepsBetween(pair);
  if (steps && *steps <= static_cast<uint32_t>(options.sequence_window) &&
      AreHeldBack(manifest, options)) {
    return "held back, as pairs with evidence beyond doubt join its images already "
           "(pairs.first_neighbours)";
  }
  if (steps) {
    why = std::to_string(*steps) + " apart in the sequence (pairs.sequence_window is " +
          std::to_string(options.sequence_window) + ")";
  }
  if (a.prior.position_in_enu && b.prior.position_in_enu) {
    const Vector3d step = *b.prior.position_in_enu - *a.prior.position_in_enu;
    return why + ", " + Metres(step.head<2>().norm()) + " by GNSS (pairs.gnss_radius_m is " +
           Metres(options.gnss_radius_m) +
           ", and no more than pairs.gnss_max_neighbours of the nearest are tried)";
  }
  return why + ", and not among the most similar of either (retrieval.num_neighbours)";
}

}  // namespace orbweave
