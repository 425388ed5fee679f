// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace orbweave {

/// A whole HTML page in the style of the reports, with nothing outside it; `body` is HTML, `title`
/// is text.
[[nodiscard]] std::string HtmlPage(const std::string& title, const std::string& body);
/// A framed part of a page; all three are HTML.
[[nodiscard]] std::string Section(const std::string& heading,
                                  const std::string& subtitle,
                                  const std::string& body);
/// The head of a report: `title` and `version` are text, `line` is HTML that follows the version.
[[nodiscard]] std::string PageHead(const std::string& title,
                                   const std::string& version,
                                   const std::string& line);
/// A number to be seen first.
[[nodiscard]] std::string Card(const std::string& number,
                               const std::string& unit,
                               const std::string& what);
/// The same of a count: cards are narrow, eight digits and more are shortened.
[[nodiscard]] std::string CountCard(uint64_t count, const std::string& what);

}  // namespace orbweave
