// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_stretches.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/mapping/positioning/fit_plan.h"
#include "core/mapping/positioning/position_agreement.h"
#include "core/merging/georeference/gnss_track.h"

namespace orbweave {
namespace {

constexpr size_t kFewest = 4;
constexpr double kOtherScale = 1.5;
constexpr double kSigmas = 3.0;
constexpr double kAsStraight = 4.0 / 3.0;
// So many in a row tell of another scale by their shape.
constexpr size_t kMany = 10;
constexpr double kOtherScaleOfMany = 1.05;
constexpr double kDeviations = 4.0;  // as in CarryOnByGnss

/// A stretch that GNSS has of another length.
struct Stretch {
  std::vector<ImageId> images{};
  double in_model_m = 0.0;
  double by_gnss_m = 0.0;
  double limit = kOtherScale;  ///< of its factor

  [[nodiscard]] double Factor() const {
    return std::max(in_model_m, by_gnss_m) / std::max(std::min(in_model_m, by_gnss_m), 1e-9);
  }
};

/// By the distance of its ends, and how straight it goes.
std::optional<Stretch> AskEnds(std::span<const DrivenFix> fixes) {
  if (fixes.size() < kFewest) return std::nullopt;
  const auto by_gnss = [](const DrivenFix& a, const DrivenFix& b) {
    return (a.position_in_enu - b.position_in_enu).head<2>().norm();
  };
  const auto in_model = [](const DrivenFix& a, const DrivenFix& b) {
    return (a.centre_in_world - b.centre_in_world).head<2>().norm();
  };
  const DrivenFix& first = fixes.front();
  const DrivenFix& last = fixes.back();
  Stretch stretch{.in_model_m = in_model(first, last), .by_gnss_m = by_gnss(first, last)};
  double along_model_m = 0.0;
  double along_gnss_m = 0.0;
  for (size_t i = 0; i + 1 < fixes.size(); ++i) {
    along_model_m += in_model(fixes[i], fixes[i + 1]);
    along_gnss_m += by_gnss(fixes[i], fixes[i + 1]);
  }
  const double sigma_m = std::hypot(first.horizontal_sigma_m, last.horizontal_sigma_m);
  const bool differs = std::abs(stretch.by_gnss_m - stretch.in_model_m) > kSigmas * sigma_m;
  const bool is_as_straight =
      along_gnss_m * stretch.in_model_m <= kAsStraight * along_model_m * stretch.by_gnss_m;
  if (!differs || stretch.Factor() < kOtherScale || !is_as_straight) return std::nullopt;
  return stretch;
}

/// By the scale with which all of it, seen from above, fits its positions best.
std::optional<Stretch> AskShape(std::span<const DrivenFix> fixes) {
  if (fixes.size() < kMany) return std::nullopt;
  std::vector<PlanStation> stations;
  for (const DrivenFix& fix : fixes) {
    stations.push_back({.centre = {fix.centre_in_world.x(), fix.centre_in_world.y()},
                        .position = {fix.position_in_enu.x(), fix.position_in_enu.y()},
                        .sigma_m = fix.horizontal_sigma_m});
  }
  const PlanFit fit = FitPlanRobustly(stations);
  if (!(std::abs(fit.turn) > 0.0)) return std::nullopt;
  std::vector<double> errors;
  for (const PlanStation& station : stations) errors.push_back(fit.ErrorSigmas(station));
  const double sigma =
      kErrorsShared * ScatterOfPositions(errors) * fit.SigmaOfScale(stations.size());
  const double way_m = fixes.back().way - fixes.front().way;
  const Stretch stretch{
      .in_model_m = way_m, .by_gnss_m = std::abs(fit.turn) * way_m, .limit = kOtherScaleOfMany};
  const bool differs = std::abs(std::log(std::abs(fit.turn))) > kDeviations * sigma;
  return differs && stretch.Factor() > kOtherScaleOfMany ? std::optional(stretch) : std::nullopt;
}

std::optional<Stretch> AskStretch(std::span<const DrivenFix> fixes) {
  std::optional<Stretch> stretch = AskEnds(fixes);
  if (!stretch) stretch = AskShape(fixes);
  if (!stretch) return std::nullopt;
  for (const DrivenFix& fix : fixes) stretch->images.push_back(fix.image);
  return stretch;
}

/// The stretches of one model, in the order of its drives.
std::vector<Stretch> StretchesOf(const AdjustedModel& model, const ImageManifest& manifest) {
  const GnssReport& gnss = model.report.gnss;
  const std::set<std::string> contradicted(gnss.outliers.begin(), gnss.outliers.end());
  std::vector<Stretch> stretches;
  for (const GnssDrive& drive : GnssDrivesOf({.images = model.images}, manifest)) {
    const std::span<const DrivenFix> fixes = drive.fixes;
    size_t first = 0;
    for (size_t i = 0; i <= fixes.size(); ++i) {
      if (i < fixes.size() && contradicted.contains(manifest.At(fixes[i].image).name)) continue;
      if (auto stretch = AskStretch(fixes.subspan(first, i - first)))
        stretches.push_back(*std::move(stretch));
      first = i + 1;
    }
  }
  return stretches;
}

}  // namespace

CrossCheck CheckStretches(const JobResults& results) {
  CrossCheck check{.name = "stretch_lengths", .value = 1.0, .limit = kOtherScale, .unit = "factor"};
  std::optional<Stretch> worst;
  size_t count = 0;
  for (const AdjustedModel& model : results.models) {
    if (!model.report.gnss.used) continue;
    for (Stretch& stretch : StretchesOf(model, results.manifest)) {
      ++count;
      if (!worst || stretch.Factor() > worst->Factor()) worst = std::move(stretch);
    }
  }
  if (!worst) {
    check.sentence = "no stretch of panoramas has another length than its positions";
    return check;
  }
  check.value = worst->Factor();
  check.limit = worst->limit;
  check.level = CheckLevel::kDoubtful;
  check.sentence = absl::StrFormat(
      "%d panoramas in a row, from %s to %s, extend over %.1f m of the model and over %.1f m by "
      "their positions, which it contradicts%s: either these are wrong, or the model has that "
      "stretch of another scale, as hardly a point holds it to the rest",
      worst->images.size(),
      results.manifest.At(worst->images.front()).name,
      results.manifest.At(worst->images.back()).name,
      worst->in_model_m,
      worst->by_gnss_m,
      count > 1 ? absl::StrFormat(" (%d such stretches)", count) : "");
  return check;
}

}  // namespace orbweave
