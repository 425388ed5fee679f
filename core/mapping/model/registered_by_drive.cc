// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/registered_by_drive.h"

#include <algorithm>
#include <tuple>

namespace orbweave {

std::vector<ImageSlot> RegisteredByDrive(const MappingState& state) {
  std::vector<ImageSlot> images = state.Registered();
  std::ranges::sort(images, {}, [&](ImageSlot slot) {
    const ClusterImage& image = state.Problem().images[slot];
    return std::tuple(image.drive, image.rank_in_drive, image.id);
  });
  return images;
}

}  // namespace orbweave
