// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace orbweave {

/// The sigmas of camera centres by image name from a CamerasCsv; images whose sigmas are empty are
/// left out. InvalidArgument names `source`, and line or column.
[[nodiscard]] absl::StatusOr<std::map<std::string, Eigen::Vector3d>> ParseCameraSigmas(
    std::string_view text, std::string_view source);

}  // namespace orbweave
