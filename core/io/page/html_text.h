// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace orbweave {

/// Text for the inside of an element or a quoted attribute: & < > " ' are escaped, control
/// characters and bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string EscapeHtml(std::string_view text);
/// 12345 as "12,345".
[[nodiscard]] std::string CountText(uint64_t count);
/// `value` with `digits` after the point; "-" when it is not finite.
[[nodiscard]] std::string DecimalText(double value, int digits);
/// About three significant digits without trailing zeros: "0.031", "4.2", "50", "1,250"; "-" when
/// it is not finite.
[[nodiscard]] std::string ShortText(double value);
/// A standard deviation with two significant digits, however small: "0.00031", "4.2", "130".
[[nodiscard]] std::string SigmaText(double sigma);
/// "0.4 s", "12 s", "3 min 05 s", "2 h 07 min".
[[nodiscard]] std::string DurationText(double seconds);
/// `seconds` to a tenth, for columns: "12.3".
[[nodiscard]] inline std::string SecondsText(double seconds) { return DecimalText(seconds, 1); }
/// A colour per line or part of a chart, as CSS: seven that people tell apart whatever their eyes
/// see, in turn; grey below zero.
[[nodiscard]] std::string SeriesColor(int number);

}  // namespace orbweave
