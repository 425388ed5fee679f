// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/dense/find_planes.h"
#include "core/dense/patch_match_round.h"
#include "core/dense/planar_prior.h"
#include "core/dense/plane_evidence.h"
#include "core/dense/plane_field.h"

namespace orbweave {

/// Pixels that match well on a plane keep it, but where it is rough (FindRoughPlaces) none has it.
/// Another may lie on the plane that what is seen around
/// it speaks for, or be sky where that speaks for the sky. Failing that it looks along its row and
/// column, to both sides, for the nearest that lie on a plane: it may lie on the plane that it
/// meets most often, of several on the nearest; on one that stands upright only if it meets it
/// twice, once above (so that the sky between two houses stays sky), on a level one if it meets two
/// (streets have some a kerb apart). None may lie beneath the ground, the lowest of the level
/// planes.
[[nodiscard]] PlanarPrior LayOnPlanes(int face_px,
                                      const std::vector<ReliablePoint>& points,
                                      const std::vector<FittedPlane>& planes,
                                      PlaneEvidence evidence);

/// The prior of a field: its planes (FindPlanes), and what is seen of them (GatherEvidence).
[[nodiscard]] PlanarPrior FitPlanarPrior(const PatchMatchContext& context, PlaneField& field);

}  // namespace orbweave
