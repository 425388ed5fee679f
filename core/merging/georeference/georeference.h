// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geometry/sim3.h"
#include "core/merging/georeference/drive_errors.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// Where the model stands on earth.
struct Georeference {
  /// East-north-up metres; nullopt when GNSS cannot carry the scale.
  std::optional<Sim3> enu_from_world{};
  std::string reason{};  ///< why not
  /// Robust standard deviation per axis of GNSS against the model (1.4826 median absolute
  /// residual, corrected for the parameters of the fit).
  double horizontal_scatter_m = 0.0;
  double vertical_scatter_m = 0.0;
  /// Standard deviation of the scale over the scale, from scatter and extent.
  double scale_uncertainty = 0.0;
  /// By how much less positions know of its tilt than if they were independent (TiltInflation).
  double gnss_inflation = 1.0;
  /// Where the world was bent to GNSS (DeformWorld): the farthest that an image went from where one
  /// similarity for all would put it.
  double deformation_m = 0.0;
  std::vector<DriveErrors> drive_errors{};  ///< to be taken off GNSS positions (ErrorAt)
  std::vector<CrossCheck> checks{};         ///< of drives, and of a model that GNSS contradicts
};

}  // namespace orbweave
