// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/street.h"
#include "core/synthetic/street_options.h"

namespace orbweave {

/// Places houses, camera and measurements; renders nothing.
[[nodiscard]] Street MakeStreet(const StreetOptions& options);

}  // namespace orbweave
