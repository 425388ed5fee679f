// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace orbweave {

/// What makes a facade harder to tell from others, or from itself on another day.
struct FacadeLook {
  bool plain = false;          ///< of even plaster (plain_facade.h)
  bool equal_windows = false;  ///< every window of the house is the same, blinds and all
  uint32_t wares = 0;          ///< another number: other goods, posters and letters of its shops
};

}  // namespace orbweave
