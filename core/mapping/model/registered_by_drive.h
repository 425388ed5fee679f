// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// The registered images, drive by drive, each as it was taken (ClusterImage::rank_in_drive); where
/// that is one, in order of ids.
[[nodiscard]] std::vector<ImageSlot> RegisteredByDrive(const MappingState& state);

}  // namespace orbweave
