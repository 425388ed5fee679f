// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>

#include "core/scene/reconstruction.h"

namespace orbweave {

/// Submodel `submodel` of what became of cluster `cluster`.
struct SubmodelName {
  uint32_t cluster = 0;
  uint32_t submodel = 0;
  friend auto operator<=>(const SubmodelName&, const SubmodelName&) = default;
};

/// A submodel, or as much of it as is needed (BoundaryTracksOf), in a frame and scale of its own.
struct Submodel {
  uint32_t cluster = 0;
  uint32_t submodel = 0;
  Reconstruction reconstruction{};

  [[nodiscard]] SubmodelName name() const { return {cluster, submodel}; }
};

}  // namespace orbweave
