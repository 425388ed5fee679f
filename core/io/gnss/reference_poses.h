// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// Poses by image name from a CSV with the header name,x,y,z,qw,qx,qy,qz (columns in any order,
/// others ignored): camera centre in metres and cam_from_world. InvalidArgument names `source`,
/// line and cell.
[[nodiscard]] absl::StatusOr<std::map<std::string, Rigid3>> ParseReferencePoses(
    std::string_view text, std::string_view source);

}  // namespace orbweave
