// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/merging/georeference/gnss_track.h"

namespace orbweave {

/// What GNSS says of itself, without a model.
struct GnssSmoothness {
  bool is_known = false;  ///< enough neighbours in sequence
  double noise_m = 0.0;  ///< standard deviation per horizontal axis that differs between neighbours
  double extent_m = 0.0;  ///< of the positions, rms from their mean, horizontal
};

/// Of three positions in a row, the middle one's distance from the line through the others is
/// sqrt(3/2) times the noise of an axis where carriers go straight, whatever the distances; the
/// median over a drive forgives bends, jumps and outliers. Positions that are not in sequence come
/// out with a noise as large as their distances. Errors that neighbours share do not show.
[[nodiscard]] GnssSmoothness MeasureGnssSmoothness(std::span<const GnssDrive> drives);

}  // namespace orbweave
