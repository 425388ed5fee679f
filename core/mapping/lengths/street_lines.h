// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Images of a line see each other's surroundings over so many places of it, as a rule.
inline constexpr size_t kReachAlongLine = 3;

/// Images one after the other along a street.
using StreetLine = std::vector<ImageSlot>;

/// The registered images in lines, each image in one. A line is a run of a drive - as it was taken
/// (ClusterImage::rank_in_drive; where that is one, in order of ids; where these are in no order,
/// as VoteOnOrder finds, along the way that their centres make, OrderAlongWay), from where no pair
/// leads on to where none leads on (over kReachAlongLine places), and not across places where as
/// many captures are missing, where GNSS has it left off (LeftOffBehind) or where the camera was
/// carried elsewhere: two that no pair joins, with five others half as far from the one or the
/// other that pairs join to it - or several such runs that meet end to end: a street whose
/// stretches are of different days is one line, and so are images whose ids are in no order as far
/// as pairs tell. Runs meet at those two ends that have the images of pairs between them the
/// closest together, if nine in ten of these pairs lie about them (within 2 kReachAlongLine places
/// of the line that they make, with captures of one drive that are missing between the ends, where
/// the way is as long as that). Where one end meets several, those join first that have most
/// matches. Two drives along the whole of a street are two lines. Pairs of which less than half of
/// the matches lie within `tolerance_px` of where the model has them (AgreementOfMatches) join
/// nothing: they may be of places that look alike.
///
/// In order of drives, places in them and ids; a line of several runs stands where its first one
/// would, and begins with the end that has the lowest of its runs.
[[nodiscard]] std::vector<StreetLine> FindStreetLines(const MappingState& state,
                                                      double tolerance_px);

}  // namespace orbweave
