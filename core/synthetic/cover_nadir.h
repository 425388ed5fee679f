// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/rendered_panorama.h"
#include "core/synthetic/street_hardships.h"

namespace orbweave {

/// Paints over what is more than 45 degrees below the horizon, black or blurred, and adds it to
/// what is to be ignored; leaves panoramas of the other kinds as they are.
void CoverNadir(RenderedPanorama& panorama, NadirKind nadir);

}  // namespace orbweave
