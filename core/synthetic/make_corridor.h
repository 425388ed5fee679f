// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/corridor.h"
#include "core/synthetic/corridor_options.h"

namespace orbweave {

/// A street of facades, ground and clutter seen by equally spaced panoramas, with the hardships
/// that CorridorOptions names. A point is seen by the panoramas within its own range (tracks of
/// about six), with drop-out. Noise is isotropic in the tangent plane of the bearing, so that seam
/// and poles are nowhere special. Pairs: the next `match_window` panoramas, those within 20 m where
/// streets meet, and those a period apart where facades repeat, when they have at least 15 matches.
/// Deterministic; time and memory grow linearly with the street.
[[nodiscard]] Corridor MakeCorridor(const CorridorOptions& options);

}  // namespace orbweave
