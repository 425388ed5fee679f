// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>

#include "core/mapping/lengths/gap_votes.h"

namespace orbweave {

/// What votes say of a way: how far all that lies behind it is to be shifted along it.
struct GapShift {
  double shift = 0.0;      ///< along the way, in the model's unit; 0: nowhere else
  double here = 0.0;       ///< votes with the model as it is, 50 of each pair at most
  double elsewhere = 0.0;  ///< votes with the shift, as many as here where there is none
  /// Votes with the best shift by a quarter of the way or more; where IsHere holds without looking
  /// for it, no fewer than that.
  double rival = 0.0;

  /// Whether clearly more votes want it (IsToldElsewhere).
  [[nodiscard]] bool IsClear() const;
  /// Whether votes crowd at the length that the model has: by three standard deviations of a count
  /// more than at the rival's, which is as chance and look-alikes have it.
  [[nodiscard]] bool IsHere() const;
};

/// Fewer than any shift is wanted by.
inline constexpr double kAnyDeviations = -std::numeric_limits<double>::infinity();

/// Whether votes tell anything of a way: 50 of three pairs of eight votes or more (TellsEnough).
[[nodiscard]] bool TellEnough(std::span<const LengthVote> votes);

/// The shift with which most votes agree closely (ToldLengths::CountAgreeing), of those that pairs
/// name: two of each, where its own votes crowd. It is the median of those that agree with it.
/// All is 0 where they tell too little (TellEnough). `votes`: those of one side of the gap.
[[nodiscard]] GapShift FindGapShift(const AskedRays& asked,
                                    const GapVotes& gap,
                                    std::span<const LengthVote> votes);

/// The shift between `low` and `high` with which most votes agree closely, where those of each pair
/// crowd there; elsewhere is 0 where none do, or where no shift there can have so many votes that
/// it is wanted by more than `min_deviations` (DeviationsElsewhere). How many pairs tell anything
/// does not matter.
[[nodiscard]] GapShift FindGapShiftWithin(const AskedRays& asked,
                                          const GapVotes& gap,
                                          std::span<const LengthVote> votes,
                                          double low,
                                          double high,
                                          double min_deviations = kAnyDeviations);

}  // namespace orbweave
