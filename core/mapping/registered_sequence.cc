// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registered_sequence.h"

#include <algorithm>
#include <tuple>

namespace orbweave {

RegisteredSequence::RegisteredSequence(const MappingState& state)
    : place_(state.Graph().NumImages()) {
  for (ImageSlot image = 0; image < state.Graph().NumImages(); ++image) {
    if (state.IsRegistered(image)) images_.push_back(image);
  }
  const auto& known = state.Problem().images;
  std::ranges::sort(images_, {}, [&](ImageSlot image) {
    return std::tuple(known[image].drive, known[image].rank_in_drive, known[image].id);
  });
  for (size_t i = 0; i < images_.size(); ++i) place_[images_[i]] = i;
}

}  // namespace orbweave
