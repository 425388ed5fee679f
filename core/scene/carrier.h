// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/ids.h"

namespace orbweave {

/// A side of the division of the sphere (SphereCell) in which carriers are told: three degrees.
inline constexpr int kCarrierCells = 64;
inline constexpr uint32_t kNumCarrierCells = kCarrierCells * kCarrierCells;

/// What goes along with the camera of a drive: a bonnet or dashboard, a roof rack, who walks with
/// it, a mark that a program wrote into every panorama.
struct Carrier {
  std::vector<ImageId> images{};  ///< of the drive, sorted
  std::vector<uint32_t> cells{};  ///< in which its panoramas show it, sorted
  friend bool operator==(const Carrier&, const Carrier&) = default;
};

}  // namespace orbweave
