// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_pairs/plan_matching.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "core/base/status.h"

namespace orbweave {
namespace {

/// The carriers of these images alone, without those of others.
std::vector<Carrier> CarriersOf(const std::set<ImageId>& images,
                                std::span<const Carrier> carriers) {
  std::vector<Carrier> theirs;
  for (const Carrier& carrier : carriers) {
    Carrier some{.cells = carrier.cells};
    std::ranges::set_intersection(images, carrier.images, std::back_inserter(some.images));
    if (!some.images.empty()) theirs.push_back(std::move(some));
  }
  return theirs;
}

}  // namespace

std::vector<MatchRecipe> PlanMatching(std::vector<MatchRecipe::Pair> pairs,
                                      const std::vector<Digest>& features,
                                      std::span<const Carrier> carriers,
                                      size_t pairs_per_task) {
  ORBWEAVE_CHECK(pairs_per_task > 0);
  std::vector<MatchRecipe> recipes;
  for (size_t begin = 0; begin < pairs.size(); begin += pairs_per_task) {
    const size_t end = std::min(begin + pairs_per_task, pairs.size());
    MatchRecipe recipe;
    recipe.pairs.assign(std::make_move_iterator(pairs.begin() + static_cast<std::ptrdiff_t>(begin)),
                        std::make_move_iterator(pairs.begin() + static_cast<std::ptrdiff_t>(end)));
    std::set<ImageId> images;
    for (const MatchRecipe::Pair& pair : recipe.pairs) images.insert({pair.pair.a, pair.pair.b});
    for (const ImageId id : images) recipe.images.push_back({id, features[id.value]});
    recipe.carriers = CarriersOf(images, carriers);
    recipes.push_back(std::move(recipe));
  }
  return recipes;
}

}  // namespace orbweave
