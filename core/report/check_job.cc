// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/check_job.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/quantile.h"
#include "core/io/page/group_messages.h"

namespace orbweave {
namespace {

// What this program sets out to reach: of all panoramas, and of every part that holds together, 95
// in 100 in one model. One image left out is never a sign of more.
constexpr double kWanted = 0.95;
// Below it most of the street is elsewhere than where one looks first.
constexpr double kMost = 0.5;

double ShareOf(size_t part, size_t whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::string CountOf(size_t part, size_t whole, const char* what) {
  return absl::StrCat(part, " of ", whole, " ", what);
}

/// The level of a share of which 95 % are wanted, or all but one.
CheckLevel LevelOfShare(size_t part, size_t whole) {
  if (part + 1 >= whole && part > 0) return CheckLevel::kGood;
  const double share = ShareOf(part, whole);
  return share < kMost     ? CheckLevel::kBad
         : share < kWanted ? CheckLevel::kDoubtful
                           : CheckLevel::kGood;
}

/// Down to which it is good, of `whole`.
double WantedShare(size_t whole) {
  return whole < 2 ? 1.0 : std::min(kWanted, ShareOf(whole - 1, whole));
}

CrossCheck ShareCheck(const char* name, size_t part, size_t whole, CheckLevel level) {
  return {.name = name,
          .value = ShareOf(part, whole),
          .limit = WantedShare(whole),
          .unit = "share",
          .level = level,
          .bound = CheckBound::kAtLeast};
}

CrossCheck CheckRegistered(const JobReport& report) {
  const size_t total = report.images.size();
  const bool none = report.registered == 0;
  CrossCheck check = ShareCheck("images_registered",
                                report.registered,
                                std::max<size_t>(total, 1),
                                none ? CheckLevel::kBad : LevelOfShare(report.registered, total));
  check.sentence = none ? "no panorama could be registered"
                        : CountOf(report.registered, total, "panoramas are registered");
  if (check.level != CheckLevel::kGood && !report.not_registered.empty())
    check.sentence += "; left out: " + CommonestLine(report.not_registered);
  return check;
}

/// Registered images by frame: the georeferenced models together first.
std::optional<CrossCheck> CheckFrames(const JobReport& report) {
  if (report.registered == 0) return std::nullopt;
  size_t on_earth = 0;
  size_t largest = 0;
  size_t frames = 0;
  size_t models_on_earth = 0;
  for (const ReportModel& model : report.each_model) {
    if (model.gnss.used) {
      frames += on_earth == 0 ? 1 : 0;
      on_earth += model.images;
      ++models_on_earth;
    } else {
      largest = std::max<size_t>(largest, model.images);
      ++frames;
    }
  }
  largest = std::max(largest, on_earth);
  CrossCheck check = ShareCheck(
      "images_in_one_frame", largest, report.registered, LevelOfShare(largest, report.registered));
  check.sentence =
      absl::StrCat(CountOf(largest, report.registered, "registered panoramas lie in one frame"));
  if (models_on_earth > 1)
    absl::StrAppend(&check.sentence, ", ", models_on_earth, " models joined by GNSS alone");
  if (check.level != CheckLevel::kGood) {
    absl::StrAppend(&check.sentence,
                    ", the others in ",
                    frames - 1,
                    frames == 2 ? " frame of its own" : " frames of their own",
                    ": nothing says where these models lie to each other; panoramas between them, "
                    "or GNSS positions, would");
  }
  return check;
}

/// The images of each part that verified pairs hold together, by a number of the part.
std::vector<uint32_t> PartOfImages(size_t num_images, const std::vector<ImagePair>& edges) {
  std::vector<uint32_t> part(num_images);
  std::iota(part.begin(), part.end(), 0U);
  const auto root = [&](uint32_t image) {
    while (part[image] != image) image = part[image] = part[part[image]];
    return image;
  };
  for (const ImagePair& edge : edges) {
    if (edge.a.value >= num_images || edge.b.value >= num_images) continue;
    const uint32_t a = root(edge.a.value);
    const uint32_t b = root(edge.b.value);
    part[std::max(a, b)] = std::min(a, b);
  }
  for (uint32_t image = 0; image < num_images; ++image) part[image] = root(image);
  return part;
}

std::optional<CrossCheck> CheckConnected(const JobResults& results, const JobReport& report) {
  if (report.registered == 0) return std::nullopt;
  const std::vector<uint32_t> part = PartOfImages(report.images.size(), results.view_graph.edges);
  std::map<uint32_t, std::map<uint32_t, size_t>> images_of_part_and_model;
  for (size_t i = 0; i < report.images.size(); ++i) {
    const ReportImage& image = report.images[i];
    if (image.registered && !image.loose) ++images_of_part_and_model[part[i]][image.model];
  }
  size_t together = 0;
  size_t broken = 0;
  for (const auto& [number, models] : images_of_part_and_model) {
    size_t most = 0;
    for (const auto& [model, images] : models) most = std::max(most, images);
    together += most;
    broken += models.size() > 1 ? 1 : 0;
  }
  // How bad it is that they fell apart is for the check of frames to say.
  const CheckLevel level =
      std::min(LevelOfShare(together, report.registered), CheckLevel::kDoubtful);
  CrossCheck check = ShareCheck("connected_in_one_model", together, report.registered, level);
  check.sentence = CountOf(
      together, report.registered, "registered panoramas are in the main model of their part");
  if (level != CheckLevel::kGood) {
    absl::StrAppend(&check.sentence,
                    ": ",
                    broken,
                    broken == 1 ? " part" : " parts",
                    " of the street that verified pairs hold together fell into several models");
  }
  return check;
}

/// One seam that does not fit is a place to look at; when most do not, the model is torn.
std::optional<CrossCheck> CheckSeamFits(const JobReport& report) {
  size_t certified = 0;
  size_t fitting = 0;
  const ReportSeam* worst = nullptr;
  for (const ReportSeam& seam : report.seams) {
    if (!seam.used || seam.after.Verdict() == SeamVerdict::kUnknown) continue;
    ++certified;
    fitting += seam.after.Verdict() == SeamVerdict::kGood ? 1 : 0;
    if (worst == nullptr || seam.after.Ratio() > worst->after.Ratio()) worst = &seam;
  }
  if (certified == 0) return std::nullopt;
  CrossCheck check{.name = "seams_fit",
                   .value = ShareOf(fitting, certified),
                   .limit = 1.0,
                   .unit = "share",
                   .level = fitting == certified ? CheckLevel::kGood
                            : fitting + 1 < certified && ShareOf(fitting, certified) < 1.0 - kMost
                                ? CheckLevel::kBad
                                : CheckLevel::kDoubtful,
                   .sentence = CountOf(fitting, certified, "certified seams between clusters fit"),
                   .bound = CheckBound::kAtLeast};
  if (check.level != CheckLevel::kGood) {
    absl::StrAppend(&check.sentence,
                    "; the worst, between clusters ",
                    worst->cluster_a,
                    " and ",
                    worst->cluster_b,
                    ", is off by ",
                    std::lround(worst->after.Ratio()),
                    " times what noise explains: the model may be bent or torn there");
  }
  return check;
}

std::optional<CrossCheck> CheckSeamsInLoops(const JobReport& report) {
  if (report.seams.empty()) return std::nullopt;
  const auto contradicted =
      static_cast<size_t>(std::ranges::count_if(report.seams, &ReportSeam::contradicted));
  const size_t holding = report.seams.size() - contradicted;
  CrossCheck check{
      .name = "seams_in_loops",
      .value = ShareOf(holding, report.seams.size()),
      .limit = 1.0,
      .unit = "share",
      .level = contradicted == 0 ? CheckLevel::kGood : CheckLevel::kDoubtful,
      .sentence = CountOf(holding, report.seams.size(), "seams agree with the loops they close"),
      .bound = CheckBound::kAtLeast};
  if (contradicted > 0) {
    check.sentence +=
        "; the others were switched off: places that look alike, or a cluster that is bent";
  }
  const double drift = std::ranges::max(report.seams, {}, &ReportSeam::drift_factor).drift_factor;
  if (drift > 1.0) {
    check.level = CheckLevel::kDoubtful;
    check.sentence += absl::StrFormat(
        "; loops close only if clusters are bent by %.1f times as much as is expected: they are "
        "weak, or places look alike",
        drift);
  }
  return check;
}

/// A cluster all of whose seams could not be certified hangs by what nobody has looked at.
std::optional<CrossCheck> CheckCertified(const JobReport& report) {
  std::map<uint32_t, bool> is_certified;  // clusters with a used seam
  for (const ReportSeam& seam : report.seams) {
    if (!seam.used) continue;
    const bool known = seam.after.Verdict() != SeamVerdict::kUnknown;
    is_certified[seam.cluster_a] |= known;
    is_certified[seam.cluster_b] |= known;
  }
  if (is_certified.empty()) return std::nullopt;
  const auto certified = static_cast<size_t>(
      std::ranges::count_if(is_certified, [](const auto& cluster) { return cluster.second; }));
  CrossCheck check{
      .name = "clusters_certified",
      .value = ShareOf(certified, is_certified.size()),
      .limit = 1.0,
      .unit = "share",
      .level = certified == is_certified.size() ? CheckLevel::kGood : CheckLevel::kDoubtful,
      .sentence = CountOf(certified, is_certified.size(), "joined clusters have a certified seam"),
      .bound = CheckBound::kAtLeast};
  if (check.level != CheckLevel::kGood)
    check.sentence += "; whether the others fit cannot be told: too little is seen from both sides";
  return check;
}

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

/// Of the model with this number; of others than the first, where its positions put it on earth.
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

/// What the last accepted step moved, in standard deviations of a pose: a cost is half a sum of
/// squares in sigmas, so a step that lowers it by d moved n poses by (2 d / n)^(1/2) sigmas.
double LastMove(const GlobalAdjustReport& model, size_t num_images) {
  if (model.accepted_costs.empty() || model.accepted_costs.back().size() < 2) return 0.0;
  const std::vector<double>& costs = model.accepted_costs.back();
  const double decrease = costs[costs.size() - 2] - costs.back();
  return std::sqrt(std::max(2.0 * decrease, 0.0) /
                   static_cast<double>(std::max<size_t>(num_images, 1)));
}

std::optional<CrossCheck> CheckConverged(const JobResults& results) {
  CrossCheck check{.name = "adjustment_converged",
                   .limit = 1.0,
                   .unit = "sigma",
                   .sentence = "the final adjustment of every model converged"};
  bool is_known = false;
  for (size_t number = 0; number < results.models.size(); ++number) {
    const AdjustedModel& model = results.models[number];
    if (model.report.adjustments.empty()) continue;
    is_known = true;
    if (model.report.adjustments.back().converged) continue;
    const double moved = LastMove(model.report, model.images.size());
    if (moved < check.value) continue;
    check.value = moved;
    check.level = moved > check.limit ? CheckLevel::kDoubtful : CheckLevel::kGood;
    check.sentence = absl::StrCat("the final adjustment of model ",
                                  number,
                                  " stopped before it converged",
                                  moved > check.limit
                                      ? ": its last step still moved panoramas by more than their "
                                        "sigmas; allow more with bundle.max_iterations"
                                      : ", with nothing left to gain");
  }
  if (!is_known) return std::nullopt;
  return check;
}

std::optional<CrossCheck> CheckUncertainty(const JobReport& report) {
  if (report.registered == 0) return std::nullopt;
  const auto known =
      static_cast<size_t>(std::ranges::count_if(report.images, [](const ReportImage& image) {
        return image.registered && !image.loose && image.uncertainty.has_value();
      }));
  const CheckLevel level = std::min(LevelOfShare(known, report.registered), CheckLevel::kDoubtful);
  CrossCheck check = ShareCheck("uncertainty_known", known, report.registered, level);
  check.sentence =
      CountOf(known, report.registered, "registered panoramas have a known uncertainty");
  if (level != CheckLevel::kGood) {
    absl::StrAppend(&check.sentence,
                    report.uncertainty.reason.empty() ? "" : ": ",
                    report.uncertainty.reason,
                    "; how far they may be off cannot be told");
  }
  return check;
}

}  // namespace

std::vector<CrossCheck> CheckJob(const JobResults& results, const JobReport& report) {
  std::vector<CrossCheck> checks = {CheckRegistered(report)};
  for (const std::optional<CrossCheck>& check : {CheckFrames(report),
                                                 CheckConnected(results, report),
                                                 CheckSeamFits(report),
                                                 CheckSeamsInLoops(report),
                                                 CheckCertified(report),
                                                 CheckConverged(results),
                                                 CheckUncertainty(report)}) {
    if (check) checks.push_back(*check);
  }
  for (size_t model = 0; model < results.models.size(); ++model) {
    if (const auto check = CheckGnssUse(results, report, model)) checks.push_back(*check);
  }
  return checks;
}

}  // namespace orbweave
