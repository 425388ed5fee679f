// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/text_fields.h"

#include <charconv>
#include <chrono>

namespace orbweave {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

/// Reads exactly `digits` decimal digits off the front.
std::optional<int> TakeDigits(std::string_view& text, size_t digits) {
  if (text.size() < digits) return std::nullopt;
  int value = 0;
  for (size_t i = 0; i < digits; ++i) {
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    value = value * 10 + (text[i] - '0');
  }
  text.remove_prefix(digits);
  return value;
}

bool TakeOneOf(std::string_view& text, std::string_view characters) {
  if (text.empty() || characters.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

/// Reads "12<sep>34<sep>56" with fields of the given widths.
bool TakeTriple(std::string_view& text,
                size_t first_width,
                std::string_view separators,
                int (&values)[3]) {
  for (int i = 0; i < 3; ++i) {
    if (i > 0 && !TakeOneOf(text, separators)) return false;
    const std::optional<int> value = TakeDigits(text, i == 0 ? first_width : 2);
    if (!value) return false;
    values[i] = *value;
  }
  return true;
}

/// Reads ".25" if there is one; seconds.
double TakeFraction(std::string_view& text) {
  if (!TakeOneOf(text, ".")) return 0.0;
  double scale = 0.1;
  double fraction = 0.0;
  while (const std::optional<int> digit = TakeDigits(text, 1)) {
    fraction += scale * *digit;
    scale *= 0.1;
  }
  return fraction;
}

/// Reads "", "Z", "+02:00"; seconds east of UTC.
std::optional<double> TakeOffset(std::string_view& text) {
  if (text.empty() || TakeOneOf(text, "Zz")) return 0.0;
  const bool west = text.front() == '-';
  if (!TakeOneOf(text, "+-")) return std::nullopt;
  const std::optional<int> hours = TakeDigits(text, 2);
  TakeOneOf(text, ":");
  const std::optional<int> minutes = TakeDigits(text, 2);
  if (!hours || !minutes) return std::nullopt;
  return (west ? -1.0 : 1.0) * (*hours * 3600.0 + *minutes * 60.0);
}

/// Whether a spreadsheet would compute `text`, or would but for apostrophes before it.
bool IsFormula(std::string_view text) {
  const size_t first = text.find_first_not_of('\'');
  return first != std::string_view::npos &&
         std::string_view("=+-@\t\r").find(text[first]) != std::string_view::npos;
}

bool IsDefused(std::string_view text) { return text.starts_with('\'') && IsFormula(text); }

}  // namespace

std::string_view TrimmedText(std::string_view text) {
  const size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::string LowerText(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::vector<std::string_view> SplitLines(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const size_t end = text.find_first_of("\r\n");
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + (text.substr(end, 2) == "\r\n" ? 2 : 1));
  }
  return lines;
}

std::vector<std::string> SplitFields(std::string_view line, char separator) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  for (std::string& field : fields) {
    field = std::string(TrimmedText(field));
    if (IsDefused(field)) field.erase(0, 1);
  }
  return fields;
}

std::vector<std::string_view> SplitWords(std::string_view line, std::string_view separators) {
  std::vector<std::string_view> words;
  size_t begin = line.find_first_not_of(separators);
  while (begin != std::string_view::npos) {
    const size_t end = line.find_first_of(separators, begin);
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(separators, end);
  }
  return words;
}

std::optional<double> NumberFromText(std::string_view text) {
  text = TrimmedText(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> TimeFromText(std::string_view text) {
  text = TrimmedText(text);
  if (const std::optional<double> number = NumberFromText(text)) return number;
  int date[3] = {};
  int time[3] = {};
  if (!TakeTriple(text, 4, ":-", date) || !TakeOneOf(text, " T") || !TakeTriple(text, 2, ":", time))
    return std::nullopt;
  const double fraction = TakeFraction(text);
  const std::optional<double> offset_s = TakeOffset(text);
  const std::chrono::year_month_day day{std::chrono::year(date[0]),
                                        std::chrono::month(static_cast<unsigned>(date[1])),
                                        std::chrono::day(static_cast<unsigned>(date[2]))};
  if (!offset_s || !text.empty() || !day.ok()) return std::nullopt;
  const auto days = std::chrono::sys_days(day).time_since_epoch().count();
  return static_cast<double>(days) * 86400.0 + time[0] * 3600.0 + time[1] * 60.0 + time[2] +
         fraction - *offset_s;
}

std::string CsvField(std::string_view text) {
  const std::string field = (IsFormula(text) ? "'" : "") + std::string(text);
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string quoted = "\"";
  for (const char c : field) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace orbweave
