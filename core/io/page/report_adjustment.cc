// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/report_adjustment.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

std::string Row(size_t number, const ReportPhase& phase) {
  const bool has_costs = !phase.accepted_costs.empty();
  return absl::StrCat("<tr><td>",
                      number,
                      "</td><td>",
                      phase.steps,
                      "</td><td>",
                      has_costs ? DecimalText(phase.accepted_costs.front(), 1) : "-",
                      "</td><td>",
                      has_costs ? DecimalText(phase.accepted_costs.back(), 1) : "-",
                      "</td><td class=\"text",
                      phase.converged ? " good\">converged" : " warn\">stopped before it converged",
                      "</td></tr>");
}

std::string SubproblemsText(const std::vector<uint64_t>& bytes_of_subproblem) {
  if (bytes_of_subproblem.empty()) return "";
  constexpr double kBytesPerKb = 1000.0;
  const double largest_kb =
      static_cast<double>(std::ranges::max(bytes_of_subproblem)) / kBytesPerKb;
  return absl::StrCat("<p class=\"sub\">",
                      CountText(bytes_of_subproblem.size()),
                      bytes_of_subproblem.size() == 1 ? " block" : " blocks",
                      "; for a step a block sends ",
                      ShortText(largest_kb),
                      " kB at most.</p>");
}

}  // namespace

std::string AdjustmentHtml(const JobReport& report) {
  if (report.adjustments.empty() || report.adjustments.front().phases.empty()) return "";
  const ReportAdjustment& main = report.adjustments.front();
  std::string rows;
  for (size_t i = 0; i < main.phases.size(); ++i) rows += Row(i + 1, main.phases[i]);
  return "<table><thead><tr><th>round</th><th>steps</th><th>cost before</th><th>cost after</th>"
         "<th class=\"text\">end</th></tr></thead><tbody>" +
         rows + "</tbody></table>" + SubproblemsText(main.bytes_of_subproblem);
}

}  // namespace orbweave
