// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Two registered images and the points that both see.
struct Joint {
  ImageSlot a = 0;
  ImageSlot b = 0;
  uint32_t telling = 0;  ///< that a third image sees as well
  uint32_t points = 0;   ///< all
};

/// The joints that hold a submodel together: those of most telling points first, then of most
/// points, then in order of their images. Each parts it in two.
[[nodiscard]] std::vector<Joint> HoldingJoints(const MappingState& state);

/// Some of the images, which hang at the rest, and the two at the ends of the joint.
struct HungPiece {
  std::vector<ImageSlot> images{};  ///< ascending
  std::vector<ImageSlot> rest{};    ///< ascending
  ImageSlot end_in_rest = 0;
  ImageSlot end_in_piece = 0;
};

/// The smaller side of one of the holding joints.
[[nodiscard]] HungPiece PieceAt(const MappingState& state,
                                const std::vector<Joint>& holding,
                                size_t cut);

/// These images (ascending), by the joint of most points with the rest; nullopt where there is
/// none.
[[nodiscard]] std::optional<HungPiece> PieceOf(const MappingState& state,
                                               const std::vector<ImageSlot>& images);

/// Telling points that both sides see.
[[nodiscard]] uint32_t CountCommon(const MappingState& state, const HungPiece& piece);

/// The images that are not among others, which are ascending; ascending.
[[nodiscard]] std::vector<ImageSlot> Without(std::vector<ImageSlot> images,
                                             const std::vector<ImageSlot>& others);

}  // namespace orbweave
