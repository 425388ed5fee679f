// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace orbweave {

/// Positions of the vertices of a PLY file (`ascii` or `binary_little_endian`, x y z of any of its
/// number types), in the order and frame of the file. Other properties, also lists, and other
/// elements are skipped. Memory: the file and 24 bytes a vertex.
/// InvalidArgument: no such PLY, one that ends early, or one without x, y and z (the message names
/// the file and what is wrong); codes of ReadFile.
[[nodiscard]] absl::StatusOr<std::vector<Eigen::Vector3d>> ReadPlyPoints(const std::string& path);

/// The same of the file's bytes; `name` is for messages.
[[nodiscard]] absl::StatusOr<std::vector<Eigen::Vector3d>> PlyPointsFromBytes(
    std::string_view bytes, const std::string& name);

}  // namespace orbweave
