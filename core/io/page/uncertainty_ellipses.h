// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/io/page/map_view.h"

namespace orbweave {

/// Error ellipses of camera positions on the map: one sigma, enlarged by 1, 2 or 5 times a power of
/// ten, which a caption in the corner states. Along a long street the least certain image of each
/// group stands for it. An ellipse that would cover the map is cut and dashed. Empty when no image
/// has an uncertainty.
[[nodiscard]] std::string UncertaintyEllipses(const MapImages& images, const MapView& view);

}  // namespace orbweave
