// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_gnss_use.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/quantile.h"
#include "core/report/share_check.h"

namespace orbweave {
namespace {

/// Whether positions spread enough for their own noise to say anything of a model: three times the
/// stated sigma, the distance at which two positions are surely different.
bool SpreadBeyondNoise(const std::vector<const PosePrior*>& priors) {
  Eigen::Vector2d mean(0, 0);
  std::vector<double> sigmas_m;
  for (const PosePrior* prior : priors) {
    mean += prior->position_in_enu->head<2>() / static_cast<double>(priors.size());
    sigmas_m.push_back(prior->horizontal_sigma_m);
  }
  double sum_m2 = 0.0;
  for (const PosePrior* prior : priors)
    sum_m2 += (prior->position_in_enu->head<2>() - mean).squaredNorm();
  return std::sqrt(sum_m2 / static_cast<double>(priors.size())) > 3.0 * Quantile(sigmas_m, 0.5);
}

/// Root mean square distance between positions and truth by their stated sigmas, the median one.
double StatedDistance(const std::vector<const PosePrior*>& priors) {
  std::vector<double> distances_m;
  for (const PosePrior* prior : priors) {
    distances_m.push_back(
        std::hypot(prior->horizontal_sigma_m,
                   prior->horizontal_sigma_m,
                   IsHeightKnown(prior->vertical_sigma_m) ? prior->vertical_sigma_m : 0.0));
  }
  return Quantile(std::move(distances_m), 0.5);
}

/// GNSS that georeferences the model, though most of it disagrees or lies far off.
void DoubtGnssInUse(const ReportGnss& gnss, double stated_m, CrossCheck& check) {
  // The median distance is nine tenths of the root mean square one where sigmas are right.
  constexpr double kTooFar = 2.0;
  if (check.value < check.limit) {
    check.level = CheckLevel::kDoubtful;
    check.sentence += 2 * gnss.num_inliers < gnss.num_priors
                          ? ": where it stands on earth follows the fewer of them"
                          : ": the others are wrong, or the model is where they are";
  } else if (gnss.residual_median_m > kTooFar * stated_m) {
    check.level = CheckLevel::kDoubtful;
    check.value = gnss.residual_median_m;
    check.limit = kTooFar * stated_m;
    check.unit = "m";
    check.bound = CheckBound::kAtMost;
    check.sentence += absl::StrFormat(
        ", yet lie %.1f m from it in the median where their sigmas state %.1f m: either they are "
        "that wrong, or the model is bent, folded or of two scales",
        gnss.residual_median_m,
        stated_m);
  }
}

/// Positions of the images that a model holds by itself.
std::vector<const PosePrior*> PositionsOf(const JobResults& results, size_t model) {
  std::vector<const PosePrior*> priors;
  for (const auto& [id, image] : results.models[model].images) {
    const PosePrior& prior = results.manifest.At(id).prior;
    if (!image.loose && prior.position_in_enu) priors.push_back(&prior);
  }
  return priors;
}

}  // namespace

std::optional<CrossCheck> CheckGnssUse(const JobResults& results,
                                       const JobReport& report,
                                       size_t model) {
  constexpr size_t kMinPositions = 4;   // fewer never georeference
  constexpr double kMinAgreeing = 0.7;  // nor does GNSS of which less agree
  const ReportGnss& gnss = report.each_model[model].gnss;
  if (gnss.reason == "switched off" || (model > 0 && !gnss.used)) return std::nullopt;
  const std::vector<const PosePrior*> priors = PositionsOf(results, model);
  if (priors.size() < kMinPositions) return std::nullopt;
  CrossCheck check{
      .name = "gnss_used", .limit = kMinAgreeing, .unit = "share", .bound = CheckBound::kAtLeast};
  if (gnss.used) {
    check.value = ShareOf(gnss.num_inliers, gnss.num_priors);
    check.sentence =
        (model > 0 ? absl::StrCat("model ", model, ": ") : "") +
        CountOf(gnss.num_inliers, gnss.num_priors, "GNSS positions agree with the model");
    DoubtGnssInUse(gnss, StatedDistance(priors), check);
    return check;
  }
  check.sentence = absl::StrCat(priors.size(), " GNSS positions are not used: ", gnss.reason);
  if (!SpreadBeyondNoise(priors)) {
    check.limit = 0.0;  // they are no measure of it
    return check;
  }
  check.level = CheckLevel::kDoubtful;
  check.sentence += "; either they are wrong or the model is";
  return check;
}

}  // namespace orbweave
