// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/geometry/rigid3.h"
#include "core/geometry/sim3.h"

namespace orbweave {

/// How far estimated poses are from a reference.
struct PoseErrors {
  Sim3 reference_from_model{};   ///< trimmed least-squares similarity of the centres
  double position_rmse_m = 0.0;  ///< after the similarity
  double position_max_m = 0.0;
  double rotation_median_deg = 0.0;  ///< after the similarity
  double rotation_max_deg = 0.0;
  double unaligned_rmse_m = 0.0;  ///< as georeferenced, without any similarity
  double neighbour_rmse_m =
      0.0;                     ///< of the vector to the next camera in order, after the similarity
  double window_rmse_m = 0.0;  ///< centres of every 30 cameras in a row, after a similarity of
                               ///< their own: what drift along the street leaves alone
};

/// Compares cameras pair by pair, in order. The similarity is refitted on the cameras within three
/// median errors, so that a lost camera shows in the errors and does not bend the frame. A straight
/// street takes its roll from the rotations (AlignCameras). nullopt for fewer than three cameras or
/// centres in one place.
[[nodiscard]] std::optional<PoseErrors> ComparePoses(std::span<const Rigid3> cams_from_model,
                                                     std::span<const Rigid3> cams_from_reference);

}  // namespace orbweave
