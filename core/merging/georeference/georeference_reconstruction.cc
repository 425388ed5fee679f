// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/georeference_reconstruction.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/base/random.h"
#include "core/estimators/estimate_similarity.h"
#include "core/geometry/rotation.h"
#include "core/merging/georeference/cluster_spreads.h"
#include "core/merging/georeference/estimate_gravity.h"
#include "core/merging/georeference/find_drive_errors.h"
#include "core/merging/georeference/find_gravity.h"
#include "core/merging/georeference/gnss_smoothness.h"
#include "core/merging/georeference/gnss_track.h"
#include "core/merging/georeference/refine_georeference.h"
#include "core/merging/georeference/tilt_inflation.h"
#include "core/robust/false_alarms.h"

namespace orbweave {
namespace {

constexpr size_t kMinPositions = 4;
constexpr int kTrials = 500;
constexpr double kMaxScaleUncertainty = 0.1;
constexpr double kUsualAgreeingShare = 0.7;  // of sound positions and a sound model more agree
// No two similarities have a majority; that it is one by chance is asked as of pairs of images.
constexpr double kMinAgreeingShare = 0.5;
constexpr double kMaxLog10FalseAlarms = -4.0;
constexpr size_t kMinDrive = 8;
constexpr double kSigmaOfMad = 1.4826;
constexpr int kErrorRounds = 4;
// A model further from GNSS than this many times its noise is not noise's doing.
constexpr double kContradiction = 8.0;

// Camera centres and what GNSS says of them, less what is known to be wrong of it.
struct Positions {
  std::vector<Eigen::Vector3d> in_world{};
  std::vector<Eigen::Vector3d> in_enu{};
  std::vector<Eigen::Vector3d> sigma_m{};
  std::vector<uint32_t> drive{};

  [[nodiscard]] size_t size() const { return in_world.size(); }
  [[nodiscard]] bool KnowsHeight(size_t i) const { return IsHeightKnown(sigma_m[i].z()); }
};

Positions Collect(const std::vector<GnssDrive>& drives) {
  Positions positions;
  for (const GnssDrive& drive : drives) {
    for (const DrivenFix& fix : drive.fixes) {
      positions.in_world.push_back(fix.centre_in_world);
      positions.in_enu.push_back(fix.position_in_enu);
      positions.sigma_m.emplace_back(
          fix.horizontal_sigma_m, fix.horizontal_sigma_m, fix.vertical_sigma_m);
      positions.drive.push_back(drive.drive);
    }
  }
  return positions;
}

void TakeOff(const std::vector<DriveErrors>& errors,
             const std::vector<GnssDrive>& drives,
             const Sim3& enu_from_world,
             Positions& positions) {
  size_t i = 0;
  for (const GnssDrive& drive : drives) {
    const auto of_drive = std::ranges::find(errors, drive.drive, &DriveErrors::drive);
    for (const DrivenFix& fix : drive.fixes) {
      positions.in_enu[i] = fix.position_in_enu;
      if (of_drive != errors.end()) positions.in_enu[i] -= ErrorAt(*of_drive, fix, enu_from_world);
      ++i;
    }
  }
}

// Yaw, scale and translation from two pairs of an upright model; nullopt when either is one point.
std::optional<Sim3> UprightFromTwo(const Positions& upright, uint32_t i, uint32_t j) {
  const Eigen::Vector2d a = (upright.in_world[j] - upright.in_world[i]).head<2>();
  const Eigen::Vector2d b = (upright.in_enu[j] - upright.in_enu[i]).head<2>();
  if (!(a.norm() > 0.0) || !(b.norm() > 0.0)) return std::nullopt;
  const double yaw = std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x());
  Sim3 enu_from_world;
  enu_from_world.scale = b.norm() / a.norm();
  enu_from_world.rotation = RotationFromVector({0.0, 0.0, yaw});
  const Eigen::Vector3d middle = 0.5 * (upright.in_world[i] + upright.in_world[j]);
  enu_from_world.translation =
      0.5 * (upright.in_enu[i] + upright.in_enu[j]) - enu_from_world * middle;
  return enu_from_world;
}

// Sum of squared horizontal residuals in sigmas, each 9 (three sigmas) at most: a mount that leans
// lifts the ends of a model far off.
double TruncatedCost(const Positions& positions, const Sim3& enu_from_world) {
  double cost = 0.0;
  for (size_t i = 0; i < positions.size(); ++i) {
    const Eigen::Vector3d residual = enu_from_world * positions.in_world[i] - positions.in_enu[i];
    cost += std::min(9.0, residual.cwiseQuotient(positions.sigma_m[i]).head<2>().squaredNorm());
  }
  return cost;
}

// Of known heights; where none is, of those that stand in for them.
double MedianHeightError(const Positions& positions, const Sim3& enu_from_world) {
  std::vector<double> known;
  std::vector<double> unknown;
  for (size_t i = 0; i < positions.size(); ++i) {
    (positions.KnowsHeight(i) ? known : unknown)
        .push_back((enu_from_world * positions.in_world[i] - positions.in_enu[i]).z());
  }
  return Quantile(known.empty() ? std::move(unknown) : std::move(known), 0.5);
}

double MedianSigma_m(const Positions& positions) {
  std::vector<double> sigmas_m;
  for (const Eigen::Vector3d& sigma_m : positions.sigma_m) sigmas_m.push_back(sigma_m.x());
  return Quantile(std::move(sigmas_m), 0.5);
}

absl::StatusOr<std::optional<Sim3>> EstimateUpright(const Positions& upright,
                                                    const StageContext& context) {
  Random random(context.seed);
  std::optional<Sim3> best;
  double best_cost = 0.0;
  const auto n = static_cast<uint32_t>(upright.size());
  for (int trial = 0; trial < kTrials; ++trial) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    const uint32_t i = random.Index(n);
    const uint32_t j = (i + 1 + random.Index(n - 1)) % n;
    const std::optional<Sim3> candidate = UprightFromTwo(upright, i, j);
    if (!candidate) continue;
    const double cost = TruncatedCost(upright, *candidate);
    if (best && cost >= best_cost) continue;
    best = candidate;
    best_cost = cost;
  }
  if (best) best->translation.z() -= MedianHeightError(upright, *best);
  return best;
}

Sim3 Refine(const Positions& positions,
            const std::optional<Gravity>& gravity,
            double inflation,
            const Sim3& enu_from_world) {
  return RefineGeoreference({positions.in_world, positions.in_enu, positions.sigma_m},
                            gravity,
                            inflation,
                            enu_from_world);
}

bool LeansTooFar(const Gravity& gravity, const Sim3& enu_from_world) {
  return AngleBetween(enu_from_world.rotation * gravity.down_in_world, -Eigen::Vector3d::UnitZ()) >
         kMaxLean_rad;
}

// With the model turned about its origin.
Positions Turned(const Eigen::Quaterniond& rotation, Positions positions) {
  const Sim3 turn{1.0, rotation, Eigen::Vector3d::Zero()};
  for (Eigen::Vector3d& point : positions.in_world) point = turn * point;
  return positions;
}

// With down where gravity says.
absl::StatusOr<std::optional<Sim3>> EstimateLevel(const Positions& positions,
                                                  const Gravity& gravity,
                                                  const StageContext& context) {
  const Sim3 upright_from_world{
      1.0, UprightFromDown(gravity.down_in_world), Eigen::Vector3d::Zero()};
  const Positions upright = Turned(upright_from_world.rotation, positions);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<Sim3> start, EstimateUpright(upright, context));
  if (!start) return std::optional<Sim3>();
  return std::optional<Sim3>(*start * upright_from_world);
}

absl::StatusOr<std::optional<Sim3>> Estimate(const Positions& positions,
                                             const std::optional<Gravity>& gravity,
                                             const StageContext& context) {
  if (!gravity) {
    const double max_error_m = 3.0 * MedianSigma_m(positions);
    ORBWEAVE_ASSIGN_OR_RETURN(
        const std::optional<RobustSimilarity> robust,
        EstimateSimilarity(positions.in_world, positions.in_enu, max_error_m, context));
    if (!robust) return std::optional<Sim3>();
    return std::optional<Sim3>(Refine(positions, gravity, 1.0, robust->b_from_a));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<Sim3> start,
                            EstimateLevel(positions, *gravity, context));
  if (!start) return std::optional<Sim3>();
  // No mount leans so far: something else is wrong with the heights, and shows better from upright.
  const Sim3 refined = Refine(positions, gravity, 1.0, *start);
  return std::optional<Sim3>(LeansTooFar(*gravity, refined) ? *start : refined);
}

// Model minus GNSS, without the bias (median) of each drive that is long enough to have one.
std::vector<Eigen::Vector3d> Residuals(const Positions& positions, const Sim3& enu_from_world) {
  std::vector<Eigen::Vector3d> residuals;
  std::map<uint32_t, std::vector<size_t>> members;
  for (size_t i = 0; i < positions.size(); ++i) {
    residuals.push_back(enu_from_world * positions.in_world[i] - positions.in_enu[i]);
    members[positions.drive[i]].push_back(i);
  }
  for (const auto& [drive, indices] : members) {
    if (members.size() == 1 || indices.size() < kMinDrive) continue;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const size_t i : indices) values.push_back(residuals[i][axis]);
      const double bias = Quantile(std::move(values), 0.5);
      for (const size_t i : indices) residuals[i][axis] -= bias;
    }
  }
  return residuals;
}

void MeasureScatter(const Positions& positions,
                    const std::vector<Eigen::Vector3d>& residuals,
                    Georeference& result) {
  std::vector<double> horizontal;
  std::vector<double> vertical;
  for (size_t i = 0; i < residuals.size(); ++i) {
    horizontal.push_back(std::abs(residuals[i].x()));
    horizontal.push_back(std::abs(residuals[i].y()));
    if (positions.KnowsHeight(i)) vertical.push_back(std::abs(residuals[i].z()));
  }
  // The fit has taken seven of the 3n degrees of freedom.
  const auto n = static_cast<double>(residuals.size());
  const double sigma_of_median = kSigmaOfMad * std::sqrt(3.0 * n / (3.0 * n - 7.0));
  result.horizontal_scatter_m = sigma_of_median * Quantile(std::move(horizontal), 0.5);
  result.vertical_scatter_m = sigma_of_median * Quantile(std::move(vertical), 0.5);
}

// Positions within three sigmas of the model, horizontally: those that they state or, where that
// is more, those of their scatter, which of a handful may be next to nothing.
struct Agreement {
  size_t agreeing = 0;
  size_t all = 0;
  double within_m = 0.0;  // in the median

  [[nodiscard]] double Share() const {
    return static_cast<double>(agreeing) / static_cast<double>(all);
  }
  [[nodiscard]] bool IsUsual() const { return Share() >= kUsualAgreeingShare; }
  // Of a majority: by chance a position would lie as near anywhere along a street of that extent.
  [[nodiscard]] bool IsEvident(double extent_m) const {
    return Share() > kMinAgreeingShare &&
           Log10FalseAlarms(all, agreeing, 2, std::min(1.0, within_m / extent_m)) <=
               kMaxLog10FalseAlarms;
  }
  [[nodiscard]] std::string Sentence() const {
    return std::to_string(std::lround(100.0 * Share())) +
           " % of the GNSS positions agree with the model";
  }
};

Agreement AgreementOf(const Positions& positions,
                      const std::vector<Eigen::Vector3d>& residuals,
                      double scatter_m) {
  Agreement agreement{.all = residuals.size(),
                      .within_m = 3.0 * std::max(scatter_m, MedianSigma_m(positions))};
  for (size_t i = 0; i < residuals.size(); ++i) {
    const double sigma_m = std::max(scatter_m, positions.sigma_m[i].x());
    agreement.agreeing += residuals[i].head<2>().norm() <= 3.0 * sigma_m ? 1U : 0U;
  }
  return agreement;
}

std::string Metres(double value_m) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f m", value_m);
  return text;
}

// Measures the scatter and drops the similarity when GNSS cannot carry its scale.
Agreement Judge(const Positions& positions, Georeference& result) {
  const std::vector<Eigen::Vector3d> residuals = Residuals(positions, *result.enu_from_world);
  MeasureScatter(positions, residuals, result);
  const double extent_m = result.enu_from_world->scale * SpreadOf(positions.in_world).rms;
  const double scatter_m = result.horizontal_scatter_m;
  result.scale_uncertainty =
      scatter_m / (extent_m * std::sqrt(static_cast<double>(positions.size())));
  const bool carries_scale =
      scatter_m < extent_m && result.scale_uncertainty <= kMaxScaleUncertainty;
  const Agreement agreement = AgreementOf(positions, residuals, scatter_m);
  if (carries_scale && (agreement.IsUsual() || agreement.IsEvident(extent_m))) return agreement;
  result.enu_from_world.reset();
  result.reason = carries_scale ? agreement.Sentence() + ": too few"
                                : "GNSS scatters by " + Metres(scatter_m) +
                                      " about a model that would extend over " + Metres(extent_m) +
                                      ": too much to carry its scale";
  return agreement;
}

// What drives have wrong in common, and how errors of neighbours hang together, are found beside a
// similarity, which is fitted again with them.
absl::Status FitWithErrors(const std::vector<GnssDrive>& drives,
                           const std::optional<Gravity>& gravity,
                           const StageContext& context,
                           Positions& positions,
                           Georeference& result) {
  for (int round = 0; round < kErrorRounds; ++round) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    FoundDriveErrors found = FindDriveErrors(drives, *result.enu_from_world);
    result.drive_errors = std::move(found.drives);
    result.checks = std::move(found.checks);
    TakeOff(result.drive_errors, drives, *result.enu_from_world, positions);
    result.gnss_inflation =
        TiltInflation(drives, positions.in_enu, gravity, *result.enu_from_world);
    // A fit that has leant over to follow two datums does not come back by itself.
    const bool has_datums = std::ranges::any_of(
        result.drive_errors, [](const DriveErrors& errors) { return !errors.offset_m.isZero(); });
    std::optional<Sim3> start = result.enu_from_world;
    if (has_datums && gravity) {
      ORBWEAVE_ASSIGN_OR_RETURN(start, EstimateLevel(positions, *gravity, context));
    }
    if (!start) continue;
    result.enu_from_world = Refine(positions, gravity, result.gnss_inflation, *start);
    if (!gravity || !LeansTooFar(*gravity, *result.enu_from_world)) continue;
    ORBWEAVE_ASSIGN_OR_RETURN(start, EstimateLevel(positions, *gravity, context));
    if (start) result.enu_from_world = start;
  }
  return absl::OkStatus();
}

// Whether GNSS, which does not fit the model, fits its likeness in a mirror: nine of ten positions
// within three sigmas, a metre at least, and altogether twice as well as the upright model.
absl::StatusOr<bool> FitsMirrored(const Positions& positions,
                                  const Gravity& gravity,
                                  const StageContext& context) {
  constexpr double kMinShare = 0.9;
  constexpr double kFarBetter = 0.5;
  Positions upright = Turned(UprightFromDown(gravity.down_in_world), positions);
  for (Eigen::Vector3d& sigma_m : upright.sigma_m) sigma_m = sigma_m.cwiseMax(1.0);
  Positions mirrored = upright;
  for (Eigen::Vector3d& point : mirrored.in_world) point.x() = -point.x();
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<Sim3> as_it_is, EstimateUpright(upright, context));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<Sim3> found, EstimateUpright(mirrored, context));
  if (!as_it_is || !found ||
      TruncatedCost(mirrored, *found) > kFarBetter * TruncatedCost(upright, *as_it_is))
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
  result.reason = "the model contradicts GNSS, which is smooth along the sequence: they are " +
                  Metres(result.horizontal_scatter_m) + " apart, GNSS scatters by " +
                  Metres(gnss.noise_m);
  result.checks.push_back(
      {.name = "gnss_against_model",
       .value = result.horizontal_scatter_m,
       .limit = kContradiction * gnss.noise_m,
       .unit = "m",
       .level = CheckLevel::kBad,
       .sentence = result.reason + "; parts of the model are in the wrong place, as where places "
                                   "that look alike are taken for one"});
}

void DoubtAgreement(const Agreement& agreement, Georeference& result) {
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

// Where no similarity holds, or hardly more than half of the positions agree with it: what else may
// be wrong with them, or with the model.
absl::Status Blame(const std::vector<GnssDrive>& drives,
                   const std::optional<Gravity>& gravity,
                   const Agreement& agreement,
                   const StageContext& context,
                   Georeference& result) {
  bool is_mirrored = false;
  if (gravity) {
    ORBWEAVE_ASSIGN_OR_RETURN(is_mirrored, FitsMirrored(Collect(drives), *gravity, context));
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

}  // namespace

absl::StatusOr<Georeference> GeoreferenceReconstruction(const Reconstruction& reconstruction,
                                                        const ImageManifest& manifest,
                                                        GnssUse use,
                                                        const StageContext& context) {
  Georeference result;
  if (use == GnssUse::kOff) {
    result.reason = "switched off";
    return result;
  }
  const std::vector<GnssDrive> drives = GnssDrivesOf(reconstruction, manifest);
  Positions positions = Collect(drives);
  if (positions.size() < kMinPositions) {
    result.reason = positions.size() == 0 ? "no image has a GNSS position"
                                          : std::to_string(positions.size()) +
                                                " images with a GNSS position are too few";
    return result;
  }
  const std::optional<Gravity> gravity = EstimateGravity(reconstruction, manifest);
  ORBWEAVE_ASSIGN_OR_RETURN(result.enu_from_world, Estimate(positions, gravity, context));
  if (!result.enu_from_world) {
    result.reason = "no similarity fits the GNSS positions to the model";
    return result;
  }
  ORBWEAVE_RETURN_IF_ERROR(FitWithErrors(drives, gravity, context, positions, result));
  const Agreement agreement = Judge(positions, result);
  if (!result.enu_from_world || !agreement.IsUsual())
    ORBWEAVE_RETURN_IF_ERROR(Blame(drives, gravity, agreement, context, result));
  return result;
}

}  // namespace orbweave
