// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/blame_gnss_or_model.h"

#include <absl/strings/str_format.h>

#include <cstddef>

#include "core/base/status.h"
#include "core/merging/georeference/estimate_georeference.h"
#include "core/merging/georeference/find_gravity.h"
#include "core/merging/georeference/gnss_positions.h"
#include "core/merging/georeference/gnss_smoothness.h"

namespace orbweave {
namespace {

// A model further from GNSS than this many times its noise is not noise's doing.
constexpr double kContradiction = 8.0;

// Whether GNSS, which does not fit the model, fits its likeness in a mirror: nine of ten positions
// within three sigmas, a metre at least, and altogether twice as well as the upright model.
absl::StatusOr<bool> FitsMirrored(const GnssPositions& positions,
                                  const Gravity& gravity,
                                  const StageContext& context) {
  constexpr double kMinShare = 0.9;
  constexpr double kFarBetter = 0.5;
  GnssPositions upright = Turned(UprightFromDown(gravity.down_in_world), positions);
  for (Eigen::Vector3d& sigma_m : upright.sigma_m) sigma_m = sigma_m.cwiseMax(1.0);
  GnssPositions mirrored = upright;
  for (Eigen::Vector3d& point : mirrored.in_world) point.x() = -point.x();
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<Sim3> as_it_is, EstimateUpright(upright, context));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<Sim3> found, EstimateUpright(mirrored, context));
  if (!as_it_is || !found ||
      HorizontalCost(mirrored, *found) > kFarBetter * HorizontalCost(upright, *as_it_is))
    return false;
  size_t agreeing = 0;
  for (size_t i = 0; i < mirrored.size(); ++i) {
    const Eigen::Vector3d residual = *found * mirrored.in_world[i] - mirrored.in_enu[i];
    agreeing += residual.cwiseQuotient(mirrored.sigma_m[i]).head<2>().norm() < 3.0 ? 1 : 0;
  }
  return static_cast<double>(agreeing) >= kMinShare * static_cast<double>(mirrored.size());
}

void BlameTheMirror(Georeference& result) {
  result.reason =
      "GNSS positions fit the model only where left and right are swapped: the pictures are "
      "mirrored, or x and y of the table are exchanged";
  result.checks.push_back({.name = "gnss_mirrored",
                           .value = 1.0,
                           .unit = "",
                           .level = CheckLevel::kBad,
                           .sentence = result.reason});
}

// Where GNSS is smooth along the sequence and the model goes elsewhere, it is the model that is
// wrong.
void BlameTheRight(const std::vector<GnssDrive>& drives, Georeference& result) {
  const GnssSmoothness gnss = MeasureGnssSmoothness(drives);
  if (!gnss.is_known || result.horizontal_scatter_m <= kContradiction * gnss.noise_m ||
      gnss.extent_m <= kContradiction * gnss.noise_m)
    return;
  result.reason = absl::StrFormat(
      "the model contradicts GNSS, which is smooth along the sequence: they are %.1f m apart, GNSS "
      "scatters by %.1f m",
      result.horizontal_scatter_m,
      gnss.noise_m);
  result.checks.push_back(
      {.name = "gnss_against_model",
       .value = result.horizontal_scatter_m,
       .limit = kContradiction * gnss.noise_m,
       .unit = "m",
       .level = CheckLevel::kBad,
       .sentence = result.reason + "; parts of the model are in the wrong place, as where places "
                                   "that look alike are taken for one"});
}

void DoubtAgreement(const GnssAgreement& agreement, Georeference& result) {
  result.checks.push_back(
      {.name = "gnss_agreement",
       .value = agreement.Share(),
       .limit = kUsualAgreeingShare,
       .unit = "share",
       .level = CheckLevel::kDoubtful,
       .sentence = agreement.Sentence() +
                   ", which stands where these have it: the others are off, or that part of the "
                   "model is; compare them with a map",
       .bound = CheckBound::kAtLeast});
}

}  // namespace

absl::Status BlameGnssOrModel(const std::vector<GnssDrive>& drives,
                              const std::optional<Gravity>& gravity,
                              const GnssAgreement& agreement,
                              const StageContext& context,
                              Georeference& result) {
  bool is_mirrored = false;
  if (gravity) {
    ORBWEAVE_ASSIGN_OR_RETURN(is_mirrored, FitsMirrored(PositionsOf(drives), *gravity, context));
  }
  if (!is_mirrored && result.enu_from_world) {
    DoubtAgreement(agreement, result);
    return absl::OkStatus();
  }
  // What was found beside a similarity that does not hold says nothing.
  result.enu_from_world.reset();
  result.drive_errors.clear();
  result.checks.clear();
  if (is_mirrored) {
    BlameTheMirror(result);
  } else {
    BlameTheRight(drives, result);
  }
  return absl::OkStatus();
}

}  // namespace orbweave
