// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace orbweave {

/// The version and the build, e.g. "0.1.0+3f2a90c1b7de": the digits are the digest of this
/// executable. A coordinator takes workers of its own build alone, since only those are sure to
/// compute the same bytes.
[[nodiscard]] std::string_view BuildVersion();

}  // namespace orbweave
