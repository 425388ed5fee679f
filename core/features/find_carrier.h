// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/features.h"

namespace orbweave {

/// A panorama of a drive and where it was taken.
struct PlacedPanorama {
  Features features{};
  Eigen::Vector2d position_in_enu = Eigen::Vector2d::Zero();
  double sigma_m = 0.0;  ///< of the position along each axis
};

/// Cells (SphereCell, kCarrierCells) in which panoramas of one drive show what goes along with the
/// camera, sorted.
///
/// A feature is fixed where another panorama has the same (descriptors no further than 0.4 apart)
/// within half a degree of it in the same cell, and nothing within seven degrees looks as much like
/// it (ratio 0.8): along a kerb or the eaves of a straight street all looks alike. Of two panoramas
/// that positions have so far apart that a thing would have to be two kilometres away to seem
/// fixed, and further than four of their sigmas, features of the scene hardly ever are: by place
/// and descriptor alone 1.5 of 10,000 per pair of a town's streets, of which 1.2 by chance, as many
/// as when one of the two is turned by a tenth of the circle; across a dashboard 430, and 1 by
/// chance. A cell with fixed features in a twentieth of these pairs, three at least, is the
/// carrier's, and so is one beside such a cell with a hundredth: a driver moves, and light changes.
/// Twenty-four panoramas across that dashboard leave twice as much fixed as the town has. Where a
/// street goes straight on for the whole of a drive, hills beyond its end and clouds are taken for
/// a part of the carrier.
[[nodiscard]] std::vector<uint32_t> FindCarrier(std::span<const PlacedPanorama> panoramas);

}  // namespace orbweave
