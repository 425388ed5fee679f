// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace orbweave {

/// Head of a binary PLY file of points, little-endian: double x y z, then `properties`, lines of
/// "property TYPE NAME". As long for every count, so that a file that was written from the front
/// can be given its own at the end: a comment fills up what shorter numbers leave.
[[nodiscard]] std::string PlyHead(uint64_t num_points, std::string_view properties);

}  // namespace orbweave
