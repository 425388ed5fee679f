// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/synthetic/corridor_options.h"
#include "core/synthetic/street_path.h"

namespace orbweave {

/// A stretch of the street as long as the distance between panoramas.
struct CorridorCell {
  PathPlace place{};  ///< its middle
  bool in_tunnel = false;
  bool sees_street = true;  ///< so does the mouth of a tunnel
};

/// Where a panorama is taken.
struct CorridorStation {
  PathPlace place{};
  uint32_t cell = 0;      ///< of the street
  uint32_t drive = 0;     ///< 0 or 1
  bool standing = false;  ///< at the place of the panorama before, but for a tremble
};

/// The axis of a corridor's street and the places of its panoramas, in order. The median of the
/// places is the origin: where a reader of their GNSS positions puts it as well.
struct CorridorPath {
  std::vector<CorridorCell> cells{};
  std::vector<CorridorStation> stations{};
};

[[nodiscard]] CorridorPath MakeCorridorPath(const CorridorOptions& options);

}  // namespace orbweave
