// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/printable_text.h"

namespace orbweave {
namespace {

bool IsAsciiControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; }

/// U+0080 to U+009F, which terminals obey as they do escape sequences.
bool IsLongControl(std::string_view sequence) {
  return sequence[0] == '\xc2' && static_cast<unsigned char>(sequence[1]) < 0xa0;
}

/// U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069: line ends and marks of direction.
bool TurnsText(std::string_view sequence) {
  if (sequence.size() != 3 || sequence[0] != '\xe2') return false;
  const auto last = static_cast<unsigned char>(sequence[2]);
  if (sequence[1] == '\x80') return last == 0x8e || last == 0x8f || (last >= 0xa8 && last <= 0xae);
  return sequence[1] == '\x81' && last >= 0xa6 && last <= 0xa9;
}

bool IsPrintable(std::string_view sequence, std::string_view kept) {
  if (sequence.size() == 1)
    return !IsAsciiControl(sequence[0]) || kept.find(sequence[0]) != std::string_view::npos;
  return !IsLongControl(sequence) && !TurnsText(sequence);
}

/// `text` with U+FFFD for bytes that are no UTF-8 and for sequences that `takes` does not take.
template <typename Takes>
std::string Replaced(std::string_view text, Takes takes) {
  std::string replaced;
  while (!text.empty()) {
    const size_t length = Utf8SequenceLength(text);
    const std::string_view sequence = text.substr(0, length);
    replaced += length > 0 && takes(sequence) ? sequence : kReplacementCharacter;
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return replaced;
}

}  // namespace

size_t Utf8SequenceLength(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const bool overlong = (lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xf0 && byte(1) < 0x90);
  const bool outside = (lead == 0xed && byte(1) > 0x9f) || (lead == 0xf4 && byte(1) > 0x8f);
  return overlong || outside ? 0 : length;
}

std::string Utf8Text(std::string_view text) {
  return Replaced(text, [](std::string_view) { return true; });
}

std::string PrintableText(std::string_view text, std::string_view kept) {
  return Replaced(text, [kept](std::string_view sequence) { return IsPrintable(sequence, kept); });
}

}  // namespace orbweave
