// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_told_steps.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "core/report/model_of_images.h"

namespace orbweave {
namespace {

constexpr uint32_t kFewestAsked = 100;
constexpr uint32_t kFewestTelling = 25;

/// Steps within models that are asked, each once.
std::vector<GapLength> AskedSteps(const JobResults& results) {
  const std::vector<int> model_of_image = ModelOfImages(results);
  std::map<ImagePair, GapLength> steps;
  for (const ClusterSummary& cluster : results.clusters) {
    for (const GapLength& gap : cluster.gap_lengths) {
      if (!AreOfOneModel(model_of_image, gap.between)) continue;
      const auto [known, is_new] = steps.try_emplace(gap.between, gap);
      if (!is_new && gap.telling_rays > known->second.telling_rays) known->second = gap;
    }
  }
  std::vector<GapLength> asked;
  for (const auto& [between, gap] : steps) {
    if (gap.rays >= kFewestAsked) asked.push_back(gap);
  }
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
