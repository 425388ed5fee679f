// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/stages/check_residual_patterns.h"

#include <algorithm>
#include <cstdio>

namespace orbweave {
namespace {

// The mean of n residuals scatters by their noise over sqrt(n). A pattern of half the noise is thus
// more than the mean of four observations leaves open: from then on more of them no longer make a
// pose better, while its sigma, which knows nothing of patterns, goes on shrinking.
constexpr double kShareOfNoise = 0.5;

CrossCheck CheckModel(size_t number, const GlobalAdjustReport& model) {
  CrossCheck check{.name = "residual_pattern",
                   .value = model.pattern_px,
                   .limit = kShareOfNoise * model.residual_px_rms,
                   .unit = "px"};
  check.level = check.value > check.limit ? CheckLevel::kDoubtful : CheckLevel::kGood;
  char text[320];
  if (check.value == 0.0) {
    std::snprintf(
        text, sizeof text, "model %zu: no residuals repeat from panorama to panorama", number);
  } else {
    std::snprintf(
        text,
        sizeof text,
        "model %zu: residuals of up to %.2f px repeat at the same place of every panorama%s",
        number,
        model.pattern_px,
        check.level == CheckLevel::kGood
            ? ""
            : ": stitched lenses that do not share a centre, or another projection; the "
              "model may be bent or stretched by more than its sigmas say");
  }
  check.sentence = text;
  return check;
}

}  // namespace

std::vector<CrossCheck> CheckResidualPatterns(const JobResults& results) {
  std::vector<CrossCheck> checks;
  for (size_t number = 0; number < results.models.size(); ++number) {
    const GlobalAdjustReport& model = results.models[number].report;
    const bool is_made = std::ranges::any_of(
        model.checks, [](const CrossCheck& check) { return check.name == "residual_pattern"; });
    if (!is_made) checks.push_back(CheckModel(number, model));
  }
  return checks;
}

}  // namespace orbweave
