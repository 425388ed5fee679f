// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace orbweave {

/// Where the costs of three neighbouring depths have their minimum, and how well they know it.
struct CostMinimum {
  float offset = 0.0F;  ///< of the inverse range, as a share of it
  float sigma = 0.0F;   ///< of the same; infinite where the costs have no minimum
  float cost = 0.0F;    ///< there
};

/// `held`, `nearer`, `farther`: 1 - zncc at inverse ranges w, w (1 + step), w (1 - step), with
/// `step_px` the parallax of a step. The minimum is that of the parabola through them, at most a
/// step away; else the cheapest of the three. Least squares of patches normalised to unit variance
/// have the residual 2 (1 - zncc) and the curvature 2 c'', so
///
///   sigma^2 = 2 (1 - zncc) / (n c'') + floor^2,
///
/// with n the number of independent taps. The floor is that of interpolation.
[[nodiscard]] CostMinimum FindMinimum(
    float held, float nearer, float farther, float step, float step_px);

}  // namespace orbweave
