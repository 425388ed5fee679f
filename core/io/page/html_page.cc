// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/html_page.h"

#include "absl/strings/str_cat.h"
#include "core/io/page/html_text.h"
#include "core/io/page/report_style.h"

namespace orbweave {

std::string HtmlPage(const std::string& title, const std::string& body) {
  return absl::StrCat(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><title>",
      EscapeHtml(title),
      "</title><style>",
      kReportStyle,
      "</style></head><body><main>\n",
      body,
      "</main></body></html>\n");
}

std::string Section(const std::string& heading,
                    const std::string& subtitle,
                    const std::string& body) {
  return absl::StrCat(
      "<section><h2>", heading, "</h2><p class=\"sub\">", subtitle, "</p>", body, "</section>\n");
}

std::string PageHead(const std::string& title,
                     const std::string& version,
                     const std::string& line) {
  return absl::StrCat("<header><h1>",
                      EscapeHtml(title),
                      "</h1><p>Orbweave ",
                      EscapeHtml(version),
                      " · ",
                      line,
                      "</p></header>\n");
}

std::string Card(const std::string& number, const std::string& unit, const std::string& what) {
  return absl::StrCat("<div class=\"card\"><b>",
                      number,
                      unit.empty() ? "" : " <small>" + unit + "</small>",
                      "</b><span>",
                      what,
                      "</span></div>");
}

std::string CountCard(uint64_t count, const std::string& what) {
  if (count < 10'000'000) return Card(CountText(count), "", what);
  return Card(DecimalText(1e-6 * static_cast<double>(count), 1), "million", what);
}

}  // namespace orbweave
