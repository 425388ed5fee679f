// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mapping/lengths/pair_length.h"

namespace orbweave {

/// Fewer agree than the model can be right with.
inline constexpr double kMinAgreeingLengths = 0.27;
/// The same across a way, told by the side of it that agrees less.
inline constexpr double kMinAgreeingAcross = 0.2;
/// Of the rays that say the model's length or the one that most say.
inline constexpr double kMinAgreeingOfTwo = 0.5;
/// Of the scales on two sides of a way the smaller in units of the larger.
inline constexpr double kMinScaleOfOther = 0.25;
/// Of the matches of pairs that lead across a way. A pair agrees when half of its matches do
/// (kAgreeingPairShare); of the worst right ones 48 % do.
inline constexpr double kMinAgreeingMatches = 1.0 / 3.0;

/// Whether so many rays of so many pairs are to be heard: 50 of three.
[[nodiscard]] bool TellsEnough(const LengthAgreement& agreement, uint32_t pairs);

/// Whether so few matches across a way agree that its two sides stand askew.
[[nodiscard]] bool IsAskew(const LengthAgreement& matches);

/// By how many standard deviations of a count more rays speak for another length than for the
/// model's: (elsewhere - here) / sqrt(elsewhere + here). 0 where none speak.
[[nodiscard]] double DeviationsElsewhere(double here, double elsewhere);
/// Two of them: another length is clearly what is told.
[[nodiscard]] bool IsToldElsewhere(double here, double elsewhere);
/// The same of rays to one wall of a street (FindWallShift), one and a half of them.
inline constexpr double kDeviationsOfWall = 1.5;
[[nodiscard]] bool IsToldByWall(double here, double elsewhere);

/// What is wrong, and of what the agreement is.
enum class LengthFaultKind {
  kImage,      ///< rays of all pairs of an image
  kWay,        ///< rays of the pairs across a way, by one side of it
  kElsewhere,  ///< of them those that say the model's length or the one that most say
  kWall,       ///< the same of rays to one wall of the street
  kScale,      ///< scales of the two sides of a way
  kHinge,      ///< matches of the pairs across a way: its sides stand askew
};

/// An image, or a piece of a street from an image on, that stands where rays say it does not.
struct LengthFault {
  ImageId image{};
  std::optional<ImageId> next{};  ///< the street is torn between the two
  LengthAgreement agreement{};
  LengthFaultKind kind = LengthFaultKind::kImage;

  /// Which agreement.Share() does not reach.
  [[nodiscard]] double MinShare() const;
};

/// What pairs say together of the lengths between images: of all pairs of an image, and, between
/// neighbours in a sequence, of the pairs that lead across there. A single image stands a house too
/// far along and contradicts its own pairs; three that do so together contradict none among them,
/// but those that lead across.
///
/// Where 50 rays and three pairs say anything and less than 27 % agree, of one side of a way less
/// than 20 %, it is a fault. In rendered streets of 24 panoramas 5 and 8 m apart without GNSS
/// (docs/hard_cases.md) 7 to 22 % agreed of an image where the model was wrong by 7 to 12 m and 5
/// to 14 % across a step 4 m too long; at the worst place of right models 30 % or more of an image,
/// and 26 % or more across a step, or 12 % where it is borne out (MeasureGapLengths), which then is
/// no fault.
///
/// So is a way of which clearly more rays say one other length than say the model's
/// (IsToldElsewhere): a step that is a tenth or a fifth too long still has many rays near it, but
/// those that are right crowd elsewhere. In such streets that were off by 1.0 and 1.6 m it was 43
/// rays against 90 and 60 against 132; in right ones never more than a tenth more.
///
/// So is a way of which the rays to one wall of the street say another length by one and a half
/// deviations (IsToldByWall): at right ways of nine rendered streets 8 to 12 m apart these were 0.9
/// at most, once 1.4, at ways that were 6 to 16 % off 1.7 to 2.9.
///
/// So is a way on whose one side steps are shorter and all that is seen is nearer than on the
/// other, both by more than four times (MeasureScaleJumps), even where it is borne out by rays: in
/// models of a street parts of which had shrunk it was 11 times and more, and 5.3 times at a corner
/// where 37 rays of houses that repeat bore out a step that was six times too long; in right ones
/// of rendered and real streets 1.5 times at most.
///
/// And so is a way of whose pairs' matches fewer than a third lie where the model's epipolar planes
/// are. Its two sides may each be right and stand askew, held together by a few wrong tracks: at
/// the corner of such a street 62 of 582 matches agreed with the model, which had 11 points in
/// common across it and was 8 degrees off; of right neighbours 48 % and more.
///
/// Ways on either side of a tear look torn as well, as what lies on one side of them leads across
/// it: of ways at fault that follow each other the one that agrees least is returned, of those that
/// more than one wall contradicts, where there are such.
///
/// Of images in order of their ids, then of ways, in order of the first image of those that follow
/// each other.
[[nodiscard]] std::vector<LengthFault> FindLengthFaults(std::span<const PairLength> pairs,
                                                        std::span<const GapLength> gaps);

}  // namespace orbweave
