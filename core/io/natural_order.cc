// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/natural_order.h"

#include <algorithm>
#include <cstddef>

namespace orbweave {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// Byte value for comparison; '/' comes first.
int Rank(char c) { return c == '/' ? -1 : static_cast<unsigned char>(c); }

std::string_view DigitsAt(std::string_view text, size_t begin) {
  size_t end = begin;
  while (end < text.size() && IsDigit(text[end])) ++end;
  return text.substr(begin, end - begin);
}

std::string_view WithoutZeros(std::string_view digits) {
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

}  // namespace

bool NaturalLess(std::string_view a, std::string_view b) {
  size_t i = 0;
  size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const std::string_view digits_a = DigitsAt(a, i);
      const std::string_view digits_b = DigitsAt(b, j);
      const std::string_view number_a = WithoutZeros(digits_a);
      const std::string_view number_b = WithoutZeros(digits_b);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
      i += digits_a.size();
      j += digits_b.size();
    } else {
      if (a[i] != b[j]) return Rank(a[i]) < Rank(b[j]);
      ++i;
      ++j;
    }
  }
  const size_t rest_a = a.size() - i;
  const size_t rest_b = b.size() - j;
  if (rest_a != rest_b) return rest_a < rest_b;
  // The same but for leading zeros: fewer first, then any fixed order.
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

}  // namespace orbweave
