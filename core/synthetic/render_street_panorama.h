// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/rendered_panorama.h"
#include "core/synthetic/street.h"
#include "core/synthetic/street_options.h"

namespace orbweave {

/// Panorama i of the street; a pure function of the options and i.
[[nodiscard]] RenderedPanorama RenderStreetPanorama(const Street& street,
                                                    const StreetOptions& options,
                                                    size_t i);

}  // namespace orbweave
