// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "core/scene/features.h"

namespace orbweave {

/// Sky blue at 0, yellow at 1/2, vermillion at 1, straight in between: bright enough for a darkened
/// photograph, and told apart by people who see red and green alike (Okabe and Ito, Color universal
/// design, 2008). `share` outside of [0, 1], or no number, counts as the nearer end.
[[nodiscard]] Rgb ColorOnScale(double share);

/// Colours for things without an order, of the same palette; the eighth is the first again.
[[nodiscard]] Rgb ColorOfNumber(size_t number);

}  // namespace orbweave
