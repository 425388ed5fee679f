// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_told_steps.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "core/report/lengths_within_models.h"

namespace orbweave {
namespace {

constexpr uint32_t kFewestAsked = 100;
constexpr uint32_t kFewestTelling = 25;

/// Steps within models that are asked, each once.
std::vector<GapLength> AskedSteps(const JobResults& results) {
  std::vector<GapLength> asked =
      LengthsWithinModels(results,
                          &ClusterSummary::gap_lengths,
                          &GapLength::between,
                          [](const GapLength& one, const GapLength& other) {
                            return one.telling_rays > other.telling_rays;
                          });
  std::erase_if(asked, [](const GapLength& gap) { return gap.rays < kFewestAsked; });
  return asked;
}

bool IsUntold(const GapLength& gap) { return gap.telling_rays < kFewestTelling; }

}  // namespace

CrossCheck CheckToldSteps(const JobResults& results) {
  CrossCheck check{.name = "told_steps",
                   .limit = kFewestTelling,
                   .unit = "count",
                   .bound = CheckBound::kAtLeast};
  const std::vector<GapLength> steps = AskedSteps(results);
  std::vector<GapLength> left_to_rays;
  std::ranges::copy_if(steps, std::back_inserter(left_to_rays), [](const GapLength& gap) {
    return !gap.is_borne_out;
  });
  const auto worst = std::ranges::min_element(left_to_rays, {}, &GapLength::telling_rays);
  check.value = worst == left_to_rays.end() ? kFewestTelling : worst->telling_rays;
  const auto untold = std::ranges::count_if(left_to_rays, IsUntold);
  if (untold == 0) {
    check.sentence = "rays that other pairs share tell how long " + std::to_string(steps.size()) +
                     " steps are, or GNSS does";
    return check;
  }
  check.level = CheckLevel::kDoubtful;
  check.sentence = "hardly anything tells how long " + std::to_string(untold) + " of " +
                   std::to_string(steps.size()) + " steps are, first the one between " +
                   results.manifest.At(worst->between.a).name + " and " +
                   results.manifest.At(worst->between.b).name + ": " +
                   std::to_string(worst->telling_rays) + " of its " + std::to_string(worst->rays) +
                   " rays; take panoramas closer together, or give exact GNSS positions";
  return check;
}

}  // namespace orbweave
