// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/synthetic/render_panorama.h"
#include "core/synthetic/rendered_panorama.h"
#include "core/synthetic/street.h"
#include "core/synthetic/street_options.h"
#include "core/synthetic/street_world.h"

namespace orbweave {

/// What is there to be seen when a panorama is taken, and how it is taken. Refers to the street.
struct StreetMoment {
  PanoramaView view;
  const StreetWorld& at_rest;                ///< of its day
  std::optional<StreetWorld> in_the_wind{};  ///< crowns of trees where gusts have pushed them
  Traffic traffic;

  [[nodiscard]] const StreetWorld& World() const { return in_the_wind ? *in_the_wind : at_rest; }
};

/// The moment of panorama i; a pure function of the options and i.
[[nodiscard]] StreetMoment MomentOf(const Street& street, const StreetOptions& options, size_t i);

/// Panorama i of the street as it looks at its moment.
[[nodiscard]] RenderedPanorama RenderStreetPanorama(const Street& street,
                                                    const StreetOptions& options,
                                                    size_t i);

}  // namespace orbweave
