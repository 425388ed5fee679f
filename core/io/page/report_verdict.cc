// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/page/report_verdict.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "core/io/page/html_page.h"
#include "core/io/page/html_text.h"
#include "core/io/page/level_text.h"

namespace orbweave {
namespace {

constexpr size_t kMaxReasons = 20;
constexpr size_t kMaxRows = 200;

/// A sign that differs in shape, not in colour alone: circle, triangle, octagon.
std::string LevelIcon(CheckLevel level) {
  constexpr std::array<const char*, 3> kSigns = {
      "<circle r=\"7\"/><path d=\"M-3.4,0.2l2.3,2.5l4.5,-5.2\"/>",
      "<path class=\"shape\" d=\"M0,-7.5l8,14.5h-16z\"/><path d=\"M0,-2.6v4.6m0,2.2v0.6\"/>",
      "<path class=\"shape\" d=\"M-3.1,-7.5h6.2l4.4,4.4v6.2l-4.4,4.4h-6.2l-4.4,-4.4v-6.2z\"/>"
      "<path d=\"M-3,-3l6,6m0,-6l-6,6\"/>"};
  return absl::StrCat("<svg class=\"level ",
                      LevelText(level),
                      "\" viewBox=\"-8.5 -8.5 17 17\" aria-hidden=\"true\">",
                      kSigns[static_cast<size_t>(level)],
                      "</svg>");
}

/// "92.8 %", "0.8 s", "3".
std::string MeasureText(double value, const std::string& unit) {
  if (unit == "share") return ShortText(100.0 * value) + " %";
  if (unit == "count" || unit.empty()) return ShortText(value);
  if (unit == "deg") return ShortText(value) + "°";
  return absl::StrCat(ShortText(value), " ", EscapeHtml(unit));
}

/// What a right model stays within. A share of 1 is met exactly, if at all.
std::string LimitText(const CrossCheck& check) {
  if (check.limit == 0.0) return "";
  const bool is_whole = check.unit == "share" && check.limit == 1.0;
  const char* sign = is_whole ? "" : check.bound == CheckBound::kAtMost ? "≤ " : "≥ ";
  return sign + MeasureText(check.limit, check.unit);
}

/// A name that may be broken at its underscores.
std::string NameHtml(const std::string& name) {
  return absl::StrReplaceAll(EscapeHtml(name), {{"_", "_<wbr/>"}});
}

std::string Row(const CrossCheck& check) {
  return absl::StrCat("<tr><td class=\"text\">",
                      LevelIcon(check.level),
                      LevelText(check.level),
                      "</td><td class=\"text\">",
                      NameHtml(check.name),
                      "</td><td>",
                      MeasureText(check.value, check.unit),
                      "</td><td>",
                      LimitText(check),
                      "</td><td class=\"text sentence\">",
                      EscapeHtml(check.sentence),
                      "</td></tr>");
}

std::string Table(const std::vector<const CrossCheck*>& checks) {
  std::string rows;
  for (size_t i = 0; i < std::min(checks.size(), kMaxRows); ++i) rows += Row(*checks[i]);
  if (checks.size() > kMaxRows) {
    absl::StrAppend(&rows,
                    "<tr><td class=\"text sentence\" colspan=\"5\">and ",
                    CountText(checks.size() - kMaxRows),
                    " more, all in report.json</td></tr>");
  }
  return "<table class=\"checks\"><thead><tr><th>level</th><th class=\"text\">check</th>"
         "<th>value</th><th>limit</th><th class=\"text\">what it says</th></tr></thead><tbody>" +
         rows + "</tbody></table>";
}

}  // namespace

std::string VerdictHtml(const JobReport& report) {
  const Verdict& verdict = report.verdict;
  std::string body;
  for (size_t i = 0; i < std::min(verdict.reasons.size(), kMaxReasons); ++i)
    absl::StrAppend(&body, "<li>", EscapeHtml(verdict.reasons[i]), "</li>");
  if (verdict.reasons.size() > kMaxReasons) {
    absl::StrAppend(
        &body, "<li>", verdict.reasons.size() - kMaxReasons, " more reasons in report.json</li>");
  }
  body = verdict.reasons.empty()
             ? absl::StrCat("<p class=\"sub\">",
                            report.checks.size(),
                            report.checks.size() == 1 ? " check finds" : " checks find",
                            " nothing that speaks against the model.</p>")
             : "<ul>" + body + "</ul>";
  for (const std::string& thing : verdict.unchecked)
    absl::StrAppend(&body, "<p class=\"sub\">Not checked: ", EscapeHtml(thing), ".</p>");
  return absl::StrCat("<section class=\"verdict ",
                      LevelText(verdict.level),
                      "\"><h2>",
                      LevelIcon(verdict.level),
                      "Verdict: ",
                      LevelText(verdict.level),
                      "</h2>",
                      body,
                      "</section>\n");
}

std::string ChecksHtml(const JobReport& report) {
  if (report.checks.empty()) return "";
  std::vector<const CrossCheck*> checks;
  for (const CrossCheck& check : report.checks) checks.push_back(&check);
  std::ranges::stable_sort(
      checks, [](const CrossCheck* x, const CrossCheck* y) { return x->level > y->level; });
  return Section("Checks",
                 "The finished model held against what did not make it. The verdict is the worst.",
                 Table(checks));
}

}  // namespace orbweave
