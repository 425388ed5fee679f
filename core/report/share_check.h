// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "core/scene/cross_check.h"

namespace orbweave {

/// What this program sets out to reach: of all panoramas, and of every part that holds together, 95
/// in 100 in one model. One image left out is never a sign of more.
inline constexpr double kWantedShare = 0.95;
/// Below it most of the street is elsewhere than where one looks first.
inline constexpr double kMostShare = 0.5;

/// 1 of none.
[[nodiscard]] double ShareOf(size_t part, size_t whole);
/// "3 of 4 panoramas are registered".
[[nodiscard]] std::string CountOf(size_t part, size_t whole, const char* what);
/// The level of a share of which kWantedShare is wanted, or all but one.
[[nodiscard]] CheckLevel LevelOfShare(size_t part, size_t whole);
/// A check of such a share, as yet without a sentence.
[[nodiscard]] CrossCheck ShareCheck(const char* name, size_t part, size_t whole, CheckLevel level);

}  // namespace orbweave
