// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/dense/depth_map.h"
#include "core/dense/plane_field.h"
#include "core/dense/reference_raster.h"

namespace orbweave {

/// Takes away the ranges that patches carry over the edge of a surface: a patch whose middle is
/// just beyond a roof still matches by the roof's part of it. Among the pixels around one, those
/// whose range is within 5 % are its surface; those farther away, or without range, are what lies
/// behind. Within 3 pixels of a behind, as far as patches with their weights are led over an edge,
/// a pixel loses its range when its level is nearer to the behind's mean than to its surface's,
/// each by its own scatter, and when
///
///   (mean - mean')^2 > variance + variance'    (surface and behind are told apart by their levels)
///
/// or it has no match of its own that correlates at 0.8 (or only a plane of the surroundings says
/// where it is): beside a hole what is not sure is more often wrong than right. Surroundings go on
/// over the edges of faces. `raster` and `field` are those the map was made of.
void TrimEdges(const ReferenceRaster& raster, const PlaneField& field, DepthMap& map);

}  // namespace orbweave
