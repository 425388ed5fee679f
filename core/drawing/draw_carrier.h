// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/base/status.h"

namespace orbweave {

/// The bytes of a PNG file, [512, 1024] and grey: a mask for all panoramas of a drive, white where
/// they show what goes along with the camera (cells of a Carrier, sorted), else black.
[[nodiscard]] absl::StatusOr<std::string> DrawCarrier(std::span<const uint32_t> cells);

}  // namespace orbweave
