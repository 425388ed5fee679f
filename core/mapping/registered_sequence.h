// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/mapping/mapping_state.h"

namespace orbweave {

/// Registered images, drive by drive, as they were taken (ClusterImage::rank_in_drive; where that
/// is one, in order of their ids), and where in this order each is.
class RegisteredSequence {
 public:
  explicit RegisteredSequence(const MappingState& state);

  [[nodiscard]] size_t size() const { return images_.size(); }
  [[nodiscard]] ImageSlot At(size_t place) const { return images_[place]; }
  /// Of a registered image.
  [[nodiscard]] size_t PlaceOf(ImageSlot image) const { return place_[image]; }

 private:
  std::vector<ImageSlot> images_{};
  std::vector<size_t> place_;
};

}  // namespace orbweave
