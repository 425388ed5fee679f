// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/mapping/lengths/registered_sequence.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Which registered images move together: those of a stretch of a line (FindStreetLines), and each
/// image of another line whose pair of most matches with the first line leads to the stretch.
class LinePieces {
 public:
  LinePieces(const MappingState& state, const MappingOptions& options);

  /// From `first` to `last` of one line, and what goes with them of others.
  [[nodiscard]] std::vector<ImageSlot> Between(ImageSlot first, ImageSlot last) const;
  /// From `first` to the end of its line.
  [[nodiscard]] std::vector<ImageSlot> From(ImageSlot first) const;
  [[nodiscard]] bool AreOfOneLine(ImageSlot one, ImageSlot other) const;
  /// The lines.
  [[nodiscard]] const RegisteredSequence& Places() const { return places_; }

 private:
  /// The image of a line with which one of another has most matches.
  [[nodiscard]] std::optional<ImageSlot> NearestOf(uint32_t line, ImageSlot image) const;

  const MappingState& state_;
  RegisteredSequence places_;
};

}  // namespace orbweave
