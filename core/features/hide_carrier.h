// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/carrier.h"
#include "core/scene/features.h"

namespace orbweave {

/// The features of a panorama without those of its carrier.
struct SceneFeatures {
  Features features{};
  std::vector<FeatureIndex> index{};  ///< in the panorama's own features, of each; ascending
};

/// The cells of an image's carrier; none where it has none.
[[nodiscard]] std::span<const uint32_t> CellsOfCarrier(std::span<const Carrier> carriers,
                                                       ImageId image);

/// Leaves out what lies in these cells (SphereCell, kCarrierCells; sorted), in facade views too.
[[nodiscard]] SceneFeatures HideCarrier(const Features& features, std::span<const uint32_t> cells);

}  // namespace orbweave
