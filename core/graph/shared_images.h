// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

/// The images of a cluster that other clusters have too, sorted.
[[nodiscard]] std::vector<ImageId> SharedImages(const Partition& partition, uint32_t cluster);

}  // namespace orbweave
