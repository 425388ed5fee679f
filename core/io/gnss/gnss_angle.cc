// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/gnss/gnss_angle.h"

#include <cmath>
#include <string>
#include <vector>

#include "absl/strings/str_replace.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

/// The text with blanks in the place of every unit.
std::string WithoutUnits(std::string_view text) {
  return absl::StrReplaceAll(absl::string_view(text.data(), text.size()),
                             {{"\xc2\xb0", " "},      // degree sign
                              {"\xc2\xba", " "},      // and what is taken for it
                              {"\xe2\x80\xb2", " "},  // prime
                              {"\xe2\x80\xb3", " "},  // double prime
                              {"'", " "},
                              {"\"", " "},
                              {":", " "},
                              {"deg", " "},
                              {"d", " "},
                              {"m", " "},
                              {"s", " "}});
}

}  // namespace

std::optional<double> GnssAngle(std::string_view text, std::string_view letters) {
  text = TrimmedText(text);
  if (const std::optional<double> number = NumberFromText(text)) return number;
  const size_t letter = text.empty() ? letters.npos : letters.find(text.back());
  if (letter == letters.npos) return std::nullopt;
  text.remove_suffix(1);
  const std::string numbers = WithoutUnits(text);
  const std::vector<std::string_view> words = SplitWords(numbers);
  if (words.empty() || words.size() > 3) return std::nullopt;
  double value = 0.0;
  double unit = 1.0;
  for (size_t i = 0; i < words.size(); ++i) {
    if (words[i].find_first_not_of("0123456789.") != std::string_view::npos) return std::nullopt;
    const std::optional<double> part = NumberFromText(words[i]);
    if (!part || (i > 0 && *part > 60.0)) return std::nullopt;
    if (i + 1 < words.size() && *part != std::floor(*part)) return std::nullopt;
    value += *part * unit;
    unit /= 60.0;
  }
  return letter == 0 ? value : -value;
}

}  // namespace orbweave
