// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/rank_next_images.h"

#include <algorithm>
#include <tuple>

namespace orbweave {

std::vector<ImageSlot> RankNextImages(const MappingState& state,
                                      std::span<const uint32_t> min_visible) {
  std::vector<ImageSlot> images;
  for (ImageSlot image = 0; image < state.Graph().NumImages(); ++image) {
    if (!state.IsRegistered(image) && state.Visible(image).Count() >= min_visible[image]) {
      images.push_back(image);
    }
  }
  std::sort(images.begin(), images.end(), [&](ImageSlot x, ImageSlot y) {
    const VisibilityPyramid& visible_x = state.Visible(x);
    const VisibilityPyramid& visible_y = state.Visible(y);
    return std::tuple(visible_y.Score(), visible_y.Count(), x) <
           std::tuple(visible_x.Score(), visible_x.Count(), y);
  });
  return images;
}

}  // namespace orbweave
