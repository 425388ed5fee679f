// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/rank_next_images.h"

#include <algorithm>
#include <tuple>

namespace orbweave {

std::vector<ImageSlot> RankNextImages(const MappingState& state,
                                      std::span<const uint32_t> min_visible,
                                      bool by_score_alone) {
  std::vector<ImageSlot> images;
  for (ImageSlot image = 0; image < state.Graph().NumImages(); ++image) {
    if (!state.IsRegistered(image) && state.Visible(image).Count() >= min_visible[image]) {
      images.push_back(image);
    }
  }
  const auto rank = [&](ImageSlot image) {
    const VisibilityPyramid& visible = state.Visible(image);
    if (by_score_alone) return uint64_t{visible.Score()};
    return uint64_t{visible.Count()} * visible.Count() * visible.Score();
  };
  std::sort(images.begin(), images.end(), [&](ImageSlot x, ImageSlot y) {
    return std::tuple(rank(y), x) < std::tuple(rank(x), y);
  });
  return images;
}

}  // namespace orbweave
