// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace orbweave {

/// A point beside the plane that was fitted to it and others.
struct PlaneResidual {
  uint32_t pixel = 0;  ///< of EquiangularRaster
  float off_m = 0.0F;
  float weight = 0.0F;  ///< 1 / sigma^2
};

/// How far a surface goes up and down about a plane, told from the errors of its points.
struct Relief {
  double variance_m2 = 0.0;
  double cells = 1.0;  ///< that have points
};

/// Points a patch apart share no pixels and so no errors; what their residuals have in common is
/// the surface's own. With r the mean residual of a cell of 16 x 16 pixels (a patch has 11 x 11),
/// each point with its weight, and g^2 the product of how many points two cells have,
///
///   v = sum g r r' / sum g   over pairs of cells with one between them, on one face,
///   e^2 = sum g^2 (r r')^2 / (sum g)^2 its variance,
///
/// whatever sigmas the points claim. Pairs along rows and along columns are summed for themselves
/// and the larger v counts: houses of a street that bends stand like the teeth of a saw, and what
/// two cells have in common they have above each other. A variance is not below zero: the relief is
/// the mean of the normal distribution (v, e) cut off there. Without pairs nothing is told.
[[nodiscard]] std::optional<Relief> ReliefOf(int face_px, std::span<const PlaneResidual> residuals);

}  // namespace orbweave
