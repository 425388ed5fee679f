// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Small readers for text tables.

namespace orbweave {

[[nodiscard]] std::string_view TrimmedText(std::string_view text);
/// ASCII letters in lower case.
[[nodiscard]] std::string LowerText(std::string_view text);
/// Lines without their ends ("\n", "\r\n", "\r"); a byte order mark is skipped.
[[nodiscard]] std::vector<std::string_view> SplitLines(std::string_view text);
/// Fields between single separators, trimmed; a field in double quotes may hold the separator, and
/// "" for a quote. The apostrophe that CsvField puts before formulas is taken off.
[[nodiscard]] std::vector<std::string> SplitFields(std::string_view line, char separator);
/// Words between runs of `separators`.
[[nodiscard]] std::vector<std::string_view> SplitWords(std::string_view line,
                                                       std::string_view separators = " \t,\r");
/// The number that is the whole of `text`; nullopt for anything else. NaN and infinity are numbers.
[[nodiscard]] std::optional<double> NumberFromText(std::string_view text);
/// Seconds since 1970 of "2016:11:13 11:16:31[.5][+02:00|Z]" (EXIF; also '-' in the date and 'T'
/// between), read as UTC without an offset; or of a plain number.
[[nodiscard]] std::optional<double> TimeFromText(std::string_view text);
/// `text` as one field of a comma-separated line, quoted where RFC 4180 asks for it. Text that
/// begins with one of = + - @, a tab or a carriage return, which spreadsheets take for a formula,
/// gets an apostrophe before it; so does such text with apostrophes, so that SplitFields finds out.
[[nodiscard]] std::string CsvField(std::string_view text);

}  // namespace orbweave
