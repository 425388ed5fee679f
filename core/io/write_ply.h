// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "absl/status/status.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// The points of a reconstruction as binary little-endian PLY: float64 x y z, uint8 red green blue.
/// Doubles, so that coordinates far from the origin keep their millimetres.
[[nodiscard]] std::string PlyFromReconstruction(const Reconstruction& reconstruction);

/// Codes of WriteFileAtomically.
[[nodiscard]] absl::Status WritePly(const Reconstruction& reconstruction, const std::string& path);

}  // namespace orbweave
