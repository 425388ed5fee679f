// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/see_few_others.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace orbweave {
namespace {

void Count(const ImagePair& pair, std::vector<uint32_t>& of_image) {
  ++of_image[pair.a.value];
  ++of_image[pair.b.value];
}

}  // namespace

bool SeeFewOthers(size_t num_images,
                  std::span<const ImagePair> tried,
                  std::span<const MatchedPair> matched) {
  constexpr uint32_t kEnough = 3;
  std::vector<uint32_t> num_tried(num_images, 0);
  for (const ImagePair& pair : tried) Count(pair, num_tried);
  std::vector<uint32_t> num_seen(num_images, 0);
  for (const MatchedPair& pair : matched) {
    if (IsBeyondDoubt(pair)) Count(pair.pair, num_seen);
  }
  size_t few = 0;
  for (size_t i = 0; i < num_images; ++i)
    few += num_seen[i] < std::min(kEnough, num_tried[i]) ? 1 : 0;
  return 2 * few > num_images;
}

}  // namespace orbweave
