// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "core/geometry/sim3.h"

namespace orbweave {

/// Holds the dense cloud in `cloud_folder` (tiles/*.ply) against samples of the true surface, a PLY
/// file in the frame of the reference, and tells precision, recall and F1 (EvaluateSurface) of what
/// two of `centres` (in that frame) see from 2 to 15 m, for people. NotFound: there is no cloud.
[[nodiscard]] absl::StatusOr<std::string> SurfaceText(const std::string& cloud_folder,
                                                      const std::string& surface,
                                                      const Sim3& reference_from_model,
                                                      std::vector<Eigen::Vector3d> centres);

}  // namespace orbweave
