// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>

#include "core/mapping/lengths/asked_rays.h"
#include "core/mapping/lengths/pair_length.h"

namespace orbweave {

/// As long as a pair is at most, in steps, to say where an image at the step stands.
inline constexpr double kMaxTie = 2.0;

/// Of steps along lines (FindStreetLines), each named by its first image, the rays that tie the
/// ends together past the step: a camera that was carried about a room, or came by again, has
/// neighbours that its own line does not know of.
///
/// A ray of an image k ties an image j, within kReachAlongLine places of the step, where a pair of
/// k and j of kMaxTie steps at most is as long in the model (kCloseTolerance) as the others of
/// k's pairs that share the ray have it - those with images of k's side of the step, where k lies
/// further along the same line, or of k's line, where that is another one. The other line ties the
/// step by as many rays as tie the one of its sides that it knows less of; of several lines that
/// counts which ties it best.
[[nodiscard]] std::map<ImageSlot, uint32_t> CountTyingRays(const AskedRays& asked,
                                                           const std::set<ImageSlot>& steps);

/// Adds them to the telling rays of steps of which fewer than a hundred tell how long they are
/// (GapLength::telling_rays). `gaps`: of MeasureGapLengths.
void AddTyingRays(const AskedRays& asked, std::span<GapLength> gaps);

}  // namespace orbweave
