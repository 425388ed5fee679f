// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/rendered_panorama.h"

namespace orbweave {

/// What noise reduction does where light is short: pixels are mixed with a Gaussian mean of
/// standard deviation `sigma_px`, wholly where that mean is darker than level 40, not at all where
/// it is brighter than 120. Columns wrap. Nothing happens for a sigma of zero.
void SoftenShade(RenderedPanorama& panorama, double sigma_px);

}  // namespace orbweave
