// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Where the camera stood: per image the first one (by slot) of its station; images that are not
/// registered are stations by themselves. An image stands where another one does when the points
/// that both see, kFewestThatTellSize and a third of its own at least, are seen under less than
/// `max_angle_rad` in the median. A camera that moves slowly has stations as far apart as that:
/// each is held against the first image of a station.
class Stations {
 public:
  Stations(const MappingState& state, double max_angle_rad);

  [[nodiscard]] ImageSlot FirstOf(ImageSlot image) const { return first_[image]; }
  /// How many stations begin before that of an image.
  [[nodiscard]] uint32_t RankOf(ImageSlot image) const { return rank_[first_[image]]; }

 private:
  std::vector<ImageSlot> first_;
  std::vector<uint32_t> rank_;
};

}  // namespace orbweave
