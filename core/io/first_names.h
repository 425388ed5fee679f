// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace orbweave {

/// "a.png, b.png, c.png, ...": the first `shown` of `names`.
[[nodiscard]] std::string FirstNames(const std::vector<std::string>& names, size_t shown);

}  // namespace orbweave
