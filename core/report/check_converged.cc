// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_converged.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

/// What the last accepted step moved, in standard deviations of a pose: a cost is half a sum of
/// squares in sigmas, so a step that lowers it by d moved n poses by (2 d / n)^(1/2) sigmas.
double LastMove(const GlobalAdjustReport& model, size_t num_images) {
  if (model.accepted_costs.empty() || model.accepted_costs.back().size() < 2) return 0.0;
  const std::vector<double>& costs = model.accepted_costs.back();
  const double decrease = costs[costs.size() - 2] - costs.back();
  return std::sqrt(std::max(2.0 * decrease, 0.0) /
                   static_cast<double>(std::max<size_t>(num_images, 1)));
}

}  // namespace

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

}  // namespace orbweave
