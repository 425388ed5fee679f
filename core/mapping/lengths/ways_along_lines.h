// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/mapping/lengths/pair_length.h"
#include "core/mapping/lengths/registered_sequence.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// The way from a registered image of a line to the next, and the pairs that lead across it: those
/// that have no more than two images of the line between theirs, as longer ones hide a step.
struct WayAlongLine {
  ImageSlot image = 0;
  ImageSlot next = 0;
  std::vector<uint32_t> pairs{};  ///< of the graph's; may be none
};

/// All of them, of lines in order, of images along them.
[[nodiscard]] std::vector<WayAlongLine> WaysAlongLines(const MappingState& state,
                                                       const RegisteredSequence& places);

/// Matches of the pairs of a model, and those that agree (AgreementOfMatches); each pair is asked
/// once. Refers to the state, which stays as it is.
class AgreeingMatches {
 public:
  AgreeingMatches(const MappingState& state, double tolerance_px)
      : state_(state), tolerance_px_(tolerance_px), of_pair_(state.Graph().pairs.size()) {}

  /// By its place in the graph's.
  [[nodiscard]] const LengthAgreement& OfPair(uint32_t pair);
  /// Of all pairs that lead across (GapLength::matches).
  [[nodiscard]] LengthAgreement Across(const WayAlongLine& way);

 private:
  const MappingState& state_;
  double tolerance_px_;
  std::vector<std::optional<LengthAgreement>> of_pair_;
};

}  // namespace orbweave
