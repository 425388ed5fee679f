// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/report_tables.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/io/html_page.h"
#include "core/io/html_text.h"

namespace orbweave {
namespace {

constexpr size_t kMaxRows = 200;

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
                    "</td><td>",
                    CountText(cluster.interior),
                    "</td><td>",
                    CountText(cluster.registered),
                    "</td><td>",
                    cluster.components,
                    "</td><td>",
                    CountText(cluster.points),
                    "</td><td>",
                    DecimalText(cluster.residual_px_rms, 3),
                    "</td></tr>");
  }
  return Section(
      "Clusters",
      "Parts of the job that were reconstructed on their own before they were joined.",
      "<table><thead><tr><th>cluster</th><th>images</th><th>interior</th><th>registered</"
      "th><th>components</th><th>points</th><th>rms px</th></tr></thead><tbody>" +
          rows + "</tbody></table>");
}

std::string LeftOutHtml(const JobReport& report) {
  if (report.not_registered.empty()) return "";
  std::string rows;
  for (size_t i = 0; i < std::min(report.not_registered.size(), kMaxRows); ++i) {
    absl::StrAppend(&rows,
                    "<tr><td class=\"text\">",
                    EscapeHtml(report.not_registered[i].name),
                    "</td><td class=\"text\">",
                    EscapeHtml(report.not_registered[i].reason),
                    "</td></tr>");
  }
  const size_t more =
      report.not_registered.size() - std::min(report.not_registered.size(), kMaxRows);
  if (more > 0)
    absl::StrAppend(&rows,
                    "<tr><td class=\"text\" colspan=\"2\">and ",
                    CountText(more),
                    " more, all in report.json</td></tr>");
  return Section(
      "Left out",
      absl::StrCat(CountText(report.not_registered.size()), " images are not registered."),
      "<table><thead><tr><th>image</th><th class=\"text\">reason</th></tr></thead><tbody>" + rows +
          "</tbody></table>");
}

std::string WarningsHtml(const JobReport& report) {
  if (report.warnings.empty()) return "";
  std::string items;
  for (size_t i = 0; i < std::min(report.warnings.size(), kMaxRows); ++i)
    absl::StrAppend(&items, "<li>", EscapeHtml(report.warnings[i]), "</li>");
  return Section("Warnings", "Worth knowing; the job went on.", "<ul>" + items + "</ul>");
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
