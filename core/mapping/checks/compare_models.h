// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Whether pairs are not at one about where the images of a model are: more than three matches of a
/// hundred are in pairs that do not agree with it (PairCheck::agreeing_share), or rays contradict
/// its lengths (FindLengthFaults). Where nothing repeats none is. That rays to one wall alone do is
/// no reason to grow others: ten models of two such streets had the same panorama dragged along.
[[nodiscard]] bool IsContested(const MappingState& state, const MappingOptions& options);

/// Places (cells of SphereSpread) of all images where a point of four observations or more is
/// observed. Houses that repeat give hundreds of points to two and three images a house too far
/// along; what four images see, all round, is right.
[[nodiscard]] size_t CountHeldPlaces(const MappingState& state);

/// What speaks for a model where the images are the same: (1 + rays that agree with its lengths,
/// CountAgreeingRays) (1 + places that it holds, CountHeldPlaces), by their ratios therefore.
/// Neither is enough where houses repeat. Of rendered streets with a piece a house too far along,
/// 7,270 rays agreed and 485 places were held where it was 7,554 and 507 in the right model, 7,895
/// and 448 instead of 8,444 and 473; but once 8,070 and 462 against 7,829 and 480: there the
/// matches of four neighbouring pairs are fooled, and rays like the wrong model better.
[[nodiscard]] double EvidenceFor(const MappingState& state, const MappingOptions& options);

/// Whether more speaks for the one than for the other of the same images: fewer places where rays
/// contradict its lengths (FindLengthFaults), of which each pair that it is torn at (FindTornPairs)
/// counts as three, or as many and more evidence (EvidenceFor), which has liked a model with a
/// piece of it 16 m off better than one with a step 3 m too long.
[[nodiscard]] bool SpeaksMoreFor(const MappingState& one,
                                 const MappingState& other,
                                 const MappingOptions& options);

/// The same where each image that stands off the even steps of its drive (FindUnevenRuns), and each
/// step that has vanished (FindVanishedWays), counts as three such places.
[[nodiscard]] bool RaysAndStepsSpeakMoreFor(const MappingState& one,
                                            const MappingState& other,
                                            const MappingOptions& options);

/// Whether GNSS has the one rather than the other of two models. Of about the same images, to a
/// twentieth, it bears out a quarter more of it (BorneOutImages); or not that much less, and
/// positions and rays together like it better: the squared misfit of its positions
/// (PositionMisfit), with 1.5 more for every place where rays contradict its lengths
/// (FindLengthFaults), 9 for every image off the even steps (FindUnevenRuns) or step
/// that has vanished (FindVanishedWays) and 18 for every pair
/// that it is torn at (FindTornPairs), less twenty times the logarithm of EvidenceFor; and not
/// clearly less speaks for it (four fifths of EvidenceFor), so that two positions that are wrong
/// decide nothing. Of more images it bears out as large a
/// share of it, to a twentieth, and these are not much further from their positions: on average a
/// squared misfit of at most 1.5 times one more than those of the other. Where houses repeat rays
/// may like a wrong model better: of one rendered street they contradict it in 2 places where it is
/// 13 m off, and in 3 where it is 1.2 m off, of another in 1 and in 3; positions are off by a
/// squared misfit of 123 and 46, 75 and 30.
[[nodiscard]] bool IsLikedByGnss(const MappingState& one,
                                 const MappingState& other,
                                 const MappingOptions& options);

/// Whether the one is a better model than the other: GNSS bears out half as much again of it
/// (BorneOutImages), or not that much less of it and likes it better (IsLikedByGnss), or
/// not that either and more speaks for it (SpeaksMoreFor). GNSS of some metres may bear a wrong one
/// out better by chance (18 images against 15).
[[nodiscard]] bool IsBetterModel(const MappingState& one,
                                 const MappingState& other,
                                 const MappingOptions& options);

}  // namespace orbweave
