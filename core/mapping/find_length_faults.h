// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/mapping/pair_length.h"

namespace orbweave {

/// Fewer agree than the model can be right with.
inline constexpr double kMinAgreeingLengths = 0.27;

/// An image, or a piece of a street from an image on, that stands where rays say it does not.
struct LengthFault {
  ImageId image{};
  std::optional<ImageId> next{};  ///< the street is torn between the two
  LengthAgreement agreement{};
};

/// What pairs say together of the lengths between images: of all pairs of an image, and, between
/// neighbours in a sequence, of all pairs that lead across there from one of the six before it to
/// one of the six behind. A single image stands a house too far along and contradicts its own
/// pairs; three that do so together contradict none among them, but those that lead across.
///
/// Where 50 rays and three pairs say anything and less than 27 % agree, it is a fault. In rendered
/// streets of 24 panoramas 5 and 8 m apart without GNSS (docs/hard_cases.md) 7 to 22 % agreed where
/// the model was wrong by 7 to 12 m, 30 % or more at the worst place of right models.
///
/// Of images in order of their ids, then of sequences.
[[nodiscard]] std::vector<LengthFault> FindLengthFaults(
    std::span<const PairLength> pairs, std::span<const std::vector<ImageId>> sequences);

}  // namespace orbweave
