// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Registered images, line by line (FindStreetLines), and where in this order each is.
class RegisteredSequence {
 public:
  RegisteredSequence(const MappingState& state, double tolerance_px);

  [[nodiscard]] size_t size() const { return images_.size(); }
  [[nodiscard]] ImageSlot At(size_t place) const { return images_[place]; }
  /// Of a registered image.
  [[nodiscard]] size_t PlaceOf(ImageSlot image) const { return place_[image]; }
  /// Number of the line of a registered image.
  [[nodiscard]] uint32_t LineOf(ImageSlot image) const { return line_[image]; }

 private:
  std::vector<ImageSlot> images_{};
  std::vector<size_t> place_;
  std::vector<uint32_t> line_;
};

}  // namespace orbweave
