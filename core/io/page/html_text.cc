// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/html_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

/// The escaped form of one ASCII character.
void AppendEscaped(char c, std::string& html) {
  switch (c) {
    case '&':
      html += "&amp;";
      break;
    case '<':
      html += "&lt;";
      break;
    case '>':
      html += "&gt;";
      break;
    case '"':
      html += "&quot;";
      break;
    case '\'':
      html += "&#39;";
      break;
    default:
      if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') {
        html += kReplacementCharacter;
      } else {
        html += c;
      }
  }
}

}  // namespace

std::string EscapeHtml(std::string_view text) {
  std::string html;
  while (!text.empty()) {
    const size_t length = Utf8SequenceLength(text);
    if (length == 0) {
      html += kReplacementCharacter;
    } else if (length == 1) {
      AppendEscaped(text.front(), html);
    } else {
      html += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return html;
}

std::string CountText(uint64_t count) {
  std::string text = absl::StrCat(count);
  for (size_t place = text.size(); place > 3; place -= 3) text.insert(place - 3, ",");
  return text;
}

std::string DecimalText(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  char buffer[400];
  const auto end =
      std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::fixed, digits).ptr;
  std::string text(buffer, end);
  // "-0.00" says nothing that "0.00" does not.
  if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string ShortText(double value) {
  const double size = std::abs(value);
  if (!std::isfinite(value)) return "-";
  if (size >= 1e9) return absl::StrCat(DecimalText(value / 1e9, 1), "e9");
  if (size >= 100.0) {
    return (value < 0.0 ? "-" : "") + CountText(static_cast<uint64_t>(std::llround(size)));
  }
  std::string text = DecimalText(value, size >= 10.0 ? 1 : size >= 1.0 ? 2 : 3);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string SigmaText(double sigma) {
  if (!(sigma > 0.0) || sigma >= 10.0) return ShortText(sigma);
  return DecimalText(sigma, std::min(1 - static_cast<int>(std::floor(std::log10(sigma))), 12));
}

std::string DurationText(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "-";
  if (seconds < 10.0) return DecimalText(seconds, 1) + " s";
  const int64_t whole = std::llround(seconds);
  const auto two = [](int64_t n) { return absl::StrCat(n < 10 ? "0" : "", n); };
  if (whole < 60) return absl::StrCat(whole, " s");
  if (whole < 3600) return absl::StrCat(whole / 60, " min ", two(whole % 60), " s");
  return absl::StrCat(whole / 3600, " h ", two(whole / 60 % 60), " min");
}

std::string SeriesColor(int number) {
  constexpr int kColors = 7;
  return number < 0 ? "var(--kn)" : absl::StrCat("var(--k", number % kColors, ")");
}

}  // namespace orbweave
