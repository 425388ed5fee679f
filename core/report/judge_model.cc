// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/judge_model.h"

#include <algorithm>
#include <iterator>

#include "core/io/page/group_messages.h"

namespace orbweave {
namespace {

std::vector<std::string> SentencesOf(const JobReport& report, CheckLevel level) {
  std::vector<std::string> sentences;
  for (const CrossCheck& check : report.checks) {
    if (check.level != level) continue;
    sentences.push_back(check.sentence.empty() ? "the check " + check.name + " fails"
                                               : check.sentence);
  }
  return sentences;
}

}  // namespace

Verdict JudgeModel(const JobReport& report) {
  Verdict verdict;
  for (const CrossCheck& check : report.checks)
    verdict.level = std::max(verdict.level, check.level);
  for (const CheckLevel level : {CheckLevel::kBad, CheckLevel::kDoubtful})
    std::ranges::copy(CountedLines(SentencesOf(report, level)),
                      std::back_inserter(verdict.reasons));
  if (report.registered == 0 && verdict.level != CheckLevel::kBad) {
    verdict.level = CheckLevel::kBad;
    verdict.reasons.insert(verdict.reasons.begin(), "no panorama could be registered");
  }
  return verdict;
}

}  // namespace orbweave
