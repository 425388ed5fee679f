// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/page/report_tables.h"

#include <algorithm>
#include <array>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/io/first_names.h"
#include "core/io/page/group_messages.h"
#include "core/io/page/html_page.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

constexpr size_t kMaxRows = 200;
constexpr size_t kMaxNames = 12;    ///< of images left out for the same reason
constexpr size_t kMaxWarnings = 8;  ///< shown at once

/// In the order in which they are tried.
constexpr std::array<std::pair<MatchRung, const char*>, kNumMatchRungs> kRungs = {
    {{MatchRung::kGiven, "given to the job"},
     {MatchRung::kLargest, "by the features of the largest scales alone"},
     {MatchRung::kDescriptors, "by all features"},
     {MatchRung::kUpright, "by samples of cameras that stand upright"},
     {MatchRung::kGuided, "with matches that a first pose predicts"},
     {MatchRung::kFacades, "with walls seen in their true shape"},
     {MatchRung::kPropagated, "under the rotation that two other pairs predict"}}};

}  // namespace

std::string ClustersHtml(const JobReport& report) {
  if (report.clusters.empty()) return "";
  std::string rows;
  for (size_t i = 0; i < std::min(report.clusters.size(), kMaxRows); ++i) {
    const ReportCluster& cluster = report.clusters[i];
    absl::StrAppend(&rows,
                    "<tr><td>",
                    i,
                    "</td><td>",
                    CountText(cluster.images),
                    "</td><td class=\"minor\">",
                    CountText(cluster.interior),
                    "</td><td>",
                    CountText(cluster.registered),
                    "</td><td>",
                    cluster.submodels,
                    "</td><td class=\"minor\">",
                    CountText(cluster.points),
                    "</td><td>",
                    DecimalText(cluster.residual_px_rms, 3),
                    "</td></tr>");
  }
  return Section(
      "Clusters",
      "Parts of the job that were reconstructed on their own before they were joined.",
      "<table><thead><tr><th>cluster</th><th>images</th><th class=\"minor\">interior</th>"
      "<th>registered</th><th>parts</th><th class=\"minor\">points</th><th>rms "
      "px</th></tr></thead><tbody>" +
          rows + "</tbody></table>");
}

std::string PairsHtml(const JobReport& report) {
  std::string rows;
  for (const auto& [rung, text] : kRungs) {
    const size_t pairs = report.pairs_of_rung[static_cast<size_t>(rung)];
    if (pairs > 0)
      absl::StrAppend(
          &rows, "<tr><td>", CountText(pairs), "</td><td class=\"text\">", text, "</td></tr>");
  }
  if (rows.empty()) return "";
  return Section("Verified pairs",
                 "By what was tried last for each: the next is tried where the one before is not "
                 "enough.",
                 "<table><thead><tr><th class=\"slim\">pairs</th><th class=\"text\">won</th></tr>"
                 "</thead><tbody>" +
                     rows + "</tbody></table>");
}

std::string ReasonsTable(const std::vector<Exclusion>& images) {
  std::vector<std::string> reasons;
  for (const Exclusion& image : images) reasons.push_back(image.reason);
  const std::vector<MessageGroup> groups = GroupByKind(reasons);
  std::string rows;
  for (size_t i = 0; i < std::min(groups.size(), kMaxRows); ++i) {
    std::vector<std::string> names;
    for (const size_t member : groups[i].members) names.push_back(images[member].name);
    absl::StrAppend(&rows,
                    "<tr><td>",
                    CountText(names.size()),
                    "</td><td class=\"text\">",
                    groups[i].same_words ? "" : "such as: ",
                    EscapeHtml(reasons[groups[i].members.front()]),
                    "<p class=\"sub\">",
                    EscapeHtml(FirstNames(names, kMaxNames)),
                    "</p></td></tr>");
  }
  if (groups.size() > kMaxRows) {
    absl::StrAppend(&rows,
                    "<tr><td class=\"text\" colspan=\"2\">and ",
                    CountText(groups.size() - kMaxRows),
                    " more reasons, all in report.json</td></tr>");
  }
  return "<table><thead><tr><th class=\"slim\">images</th><th "
         "class=\"text\">reason</th></tr></thead>"
         "<tbody>" +
         rows + "</tbody></table>";
}

std::string LeftOutHtml(const JobReport& report) {
  const std::vector<Exclusion>& images = report.not_registered;
  if (images.empty()) return "";
  return Section("Left out",
                 absl::StrCat(CountText(images.size()),
                              images.size() == 1 ? " image is" : " images are",
                              " not registered; all of them are in report.json and, where they "
                              "take part, in cameras.csv."),
                 ReasonsTable(images));
}

std::string WarningsHtml(const JobReport& report) {
  if (report.warnings.empty()) return "";
  const std::vector<std::string> lines = CountedLines(report.warnings);
  std::string first;
  std::string more;
  for (size_t i = 0; i < std::min(lines.size(), kMaxRows); ++i)
    absl::StrAppend(i < kMaxWarnings ? &first : &more, "<li>", EscapeHtml(lines[i]), "</li>");
  std::string body = "<ul>" + first + "</ul>";
  if (!more.empty()) {
    absl::StrAppend(&body,
                    "<details><summary>",
                    CountText(lines.size() - kMaxWarnings),
                    " more</summary><ul>",
                    more,
                    "</ul></details>");
  }
  return Section("Warnings", "Worth knowing; the job went on.", body);
}

std::string WorkersHtml(const JobReport& report) {
  if (report.workers.empty()) return "";
  std::string rows;
  for (const ReportWorker& worker : report.workers) {
    absl::StrAppend(&rows,
                    "<tr><td class=\"text\">",
                    EscapeHtml(worker.name),
                    "</td><td>",
                    worker.slots,
                    "</td><td>",
                    CountText(worker.tasks_done),
                    "</td></tr>");
  }
  return Section(
      "Workers",
      "Processes that took part.",
      "<table><thead><tr><th>worker</th><th>slots</th><th>tasks done</th></tr></thead><tbody>" +
          rows + "</tbody></table>");
}

}  // namespace orbweave
