// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace orbweave {

/// A latitude or longitude in degrees: decimal degrees with a sign, or up to three numbers
/// (degrees, minutes, seconds) between ° ' " : d m s deg or blanks, and behind them one of
/// `letters`, first the positive and then the negative one ("NS", "EW"): `47 deg 36' 36.70" N`.
/// Nullopt for anything else: a sign beside a letter, the letter of the other axis, minutes or
/// seconds beyond 60, fractions that are followed by a smaller unit.
[[nodiscard]] std::optional<double> GnssAngle(std::string_view text, std::string_view letters);

}  // namespace orbweave
