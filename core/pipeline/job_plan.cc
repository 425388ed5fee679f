// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/job_plan.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace orbweave {
absl::StatusOr<JobPlan> FindNoPlan(std::string_view kind) {
  return absl::NotFoundError(absl::StrCat("nobody has plans for jobs of kind ", std::string(kind)));
}

uint32_t StageAfter(const JobPlan& plan, uint32_t stage, const std::vector<TaskResult>& results) {
  const StageRule& last = plan.stages[stage];
  const std::string& back_to = last.back_to;
  const bool goes_on = std::ranges::any_of(
      results, [&](const TaskResult& part) { return !last.HasOnePart() || !part.recipes.empty(); });
  if (back_to.empty() || !goes_on) return stage + 1;
  const auto first = std::find_if(plan.stages.begin(),
                                  plan.stages.end(),
                                  [&](const StageRule& rule) { return rule.stage == back_to; });
  ORBWEAVE_CHECK(first - plan.stages.begin() <= stage);
  return static_cast<uint32_t>(first - plan.stages.begin());
}

std::string SelectSections(std::string_view options_text,
                           const std::vector<std::string>& sections) {
  std::string selected;
  while (!options_text.empty()) {
    const size_t length = std::min(options_text.find('\n'), options_text.size());
    const std::string_view line = options_text.substr(0, length);
    options_text.remove_prefix(std::min(length + 1, options_text.size()));
    const std::string_view section = line.substr(0, std::min(line.find('.'), line.size()));
    if (std::find(sections.begin(), sections.end(), section) == sections.end()) continue;
    selected.append(line).append("\n");
  }
  return selected;
}

std::string EncodeCollection(const std::vector<Digest>& digests) {
  std::string bytes;
  bytes.reserve(digests.size() * sizeof(Digest::bytes));
  for (const Digest& digest : digests) bytes.append(digest.bytes.begin(), digest.bytes.end());
  return bytes;
}

absl::StatusOr<std::vector<Digest>> DecodeCollection(std::string_view bytes) {
  constexpr size_t kSize = sizeof(Digest::bytes);
  if (bytes.size() % kSize != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("a collection of ", bytes.size(), " bytes is no list of digests"));
  }
  std::vector<Digest> digests(bytes.size() / kSize);
  for (size_t i = 0; i < digests.size(); ++i) {
    const std::string_view digest = bytes.substr(i * kSize, kSize);
    std::copy(digest.begin(), digest.end(), digests[i].bytes.begin());
  }
  return digests;
}

}  // namespace orbweave
