// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/see_few_others.h"

#include <algorithm>
#include <vector>

namespace orbweave {

bool SeeFewOthers(size_t num_images, std::span<const MatchedPair> matched) {
  constexpr size_t kEnough = 3;
  if (num_images < 2) return false;
  std::vector<size_t> seen(num_images, 0);
  for (const MatchedPair& pair : matched) {
    if (!IsBeyondDoubt(pair)) continue;
    ++seen[pair.pair.a.value];
    ++seen[pair.pair.b.value];
  }
  const size_t enough = std::min(kEnough, num_images - 1);
  const auto few = std::ranges::count_if(seen, [&](size_t others) { return others < enough; });
  return 2 * static_cast<size_t>(few) > num_images;
}

}  // namespace orbweave
