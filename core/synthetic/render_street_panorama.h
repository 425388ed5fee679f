// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/render_panorama.h"
#include "core/synthetic/rendered_panorama.h"
#include "core/synthetic/street.h"
#include "core/synthetic/street_options.h"
#include "core/synthetic/street_world.h"

namespace orbweave {

/// What is there to be seen when a panorama is taken, and how it is taken.
struct StreetMoment {
  PanoramaView view;
  StreetWorld world;  ///< of its day, crowns of trees where gusts have pushed them
  Traffic traffic;
};

/// The moment of panorama i; a pure function of the options and i.
[[nodiscard]] StreetMoment MomentOf(const Street& street, const StreetOptions& options, size_t i);

/// Panorama i of the street as it looks at its moment.
[[nodiscard]] RenderedPanorama RenderStreetPanorama(const Street& street,
                                                    const StreetOptions& options,
                                                    size_t i);

}  // namespace orbweave
