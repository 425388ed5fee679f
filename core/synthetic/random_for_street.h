// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "core/base/random.h"
#include "core/synthetic/street_options.h"

namespace orbweave {

/// Independent random numbers for each purpose and panorama of a street.
[[nodiscard]] Random RandomForStreet(const StreetOptions& options,
                                     const std::string& purpose,
                                     size_t i = 0);

}  // namespace orbweave
