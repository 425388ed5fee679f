// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mapping/model/triangulate_tracks.h"

namespace orbweave {

/// Share of a pair's matches that end in a common point below which it is worked on again.
constexpr double kUnderReconstructedShare = 0.5;

/// Continues or creates points from each match of a pair of registered images that is not in the
/// model.
void RetriangulatePair(MappingState& state, const LinkedPair& pair, const TrackLimits& limits);

/// For every pair of registered images of whose matches too few ended in a common point, usually
/// because they drifted apart before an adjustment brought them together again: RetriangulatePair.
/// Returns the number of observations added. Wu, Towards Linear-Time Incremental Structure from
/// Motion, 3DV 2013, section 4.
uint32_t RetriangulatePairs(MappingState& state, const TrackLimits& limits);

}  // namespace orbweave
