// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace orbweave {

/// Stands for what cannot be shown: U+FFFD.
inline constexpr std::string_view kReplacementCharacter = "\xef\xbf\xbd";

/// Length of the well-formed UTF-8 sequence at the front of `text`, which is not empty; 0 when
/// there is none.
[[nodiscard]] size_t Utf8SequenceLength(std::string_view text);

/// `text` with U+FFFD for every byte that belongs to no UTF-8: what messages between processes
/// take.
[[nodiscard]] std::string Utf8Text(std::string_view text);

/// `text`, whoever wrote it, for a terminal: control characters other than those in `kept`, marks
/// that turn the direction of writing, and bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string PrintableText(std::string_view text, std::string_view kept = "");

}  // namespace orbweave
