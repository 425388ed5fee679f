// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace orbweave {

/// The order in which people number files: runs of digits compare as numbers ("img2" < "img10"),
/// everything else byte by byte, and '/' before all other characters, so that a folder's files stay
/// together. Equal numbers with different zeros ("1", "01"): fewer zeros first. A strict total
/// order: two different names are never equivalent.
[[nodiscard]] bool NaturalLess(std::string_view a, std::string_view b);

}  // namespace orbweave
