// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/base/stage_context.h"
#include "core/scene/view_graph.h"

namespace orbweave {

struct AveragedRotations {
  /// R per image with b_from_a = R_b R_a^T; the smallest image of each connected part is the world.
  std::vector<Eigen::Quaterniond> cam_from_world{};
  std::vector<double> error_rad{};  ///< per edge: the angle between measured and averaged rotation
};

/// Rotations that agree with most edges of the graph. Start: a maximum spanning forest by inliers
/// and by how well an edge closes its triangles. Then R_i <- R_i Exp(w_i), where an edge with the
/// measurement M asks to first order for w_b - w_a = Log(R_b^T M R_a), by AverageByReweighting with
/// the inliers as weights. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<AveragedRotations> AverageRotations(const ViewGraph& graph,
                                                                 const StageContext& context);

}  // namespace orbweave
