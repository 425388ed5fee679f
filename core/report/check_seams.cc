// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_seams.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/report/share_check.h"

namespace orbweave {

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
  CrossCheck check{
      .name = "seams_fit",
      .value = ShareOf(fitting, certified),
      .limit = 1.0,
      .unit = "share",
      .level = fitting == certified ? CheckLevel::kGood
               : fitting + 1 < certified && ShareOf(fitting, certified) < 1.0 - kMostShare
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

}  // namespace orbweave
