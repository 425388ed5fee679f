// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/task_record.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

double FractionOf(const Progress& progress) {
  if (progress.total == 0) return 0.0;
  return std::min(1.0, static_cast<double>(progress.done) / static_cast<double>(progress.total));
}

}  // namespace

bool TaskRecord::HasFailedOn(const std::string& worker) const {
  return std::ranges::find(failed_on, worker) != failed_on.end();
}

bool TaskRecord::MayTake(const std::string& worker,
                         const std::vector<std::string>& alive,
                         double now_s) const {
  const auto has_failed = [this](const std::string& name) { return HasFailedOn(name); };
  if (not_before_s > now_s) return false;
  return !has_failed(worker) || std::all_of(alive.begin(), alive.end(), has_failed);
}

RunningAttempt* TaskRecord::FindAttempt(uint64_t epoch) {
  const auto it =
      std::find_if(attempts.begin(), attempts.end(), [epoch](const RunningAttempt& attempt) {
        return attempt.holder.epoch == epoch;
      });
  return it == attempts.end() ? nullptr : &*it;
}

double TaskRecord::Fraction() const {
  double fraction = 0.0;
  for (const RunningAttempt& attempt : attempts)
    fraction = std::max(fraction, FractionOf(attempt.progress));
  return fraction;
}

std::string TaskRecord::Describe() const {
  return absl::StrCat("stage ", spec.stage, ", part ", spec.part, " (task ", id.ToShortHex(), ")");
}

std::string TaskRecord::DescribeInputs() const {
  constexpr size_t kMost = 8;
  std::string text = "its inputs:";
  for (size_t i = 0; i < std::min(kMost, spec.inputs.size()); ++i)
    absl::StrAppend(&text, " ", spec.inputs[i].ToShortHex());
  if (spec.inputs.size() > kMost)
    absl::StrAppend(&text, " and ", spec.inputs.size() - kMost, " more");
  return text;
}

}  // namespace orbweave
