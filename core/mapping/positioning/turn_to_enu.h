// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "core/averaging/average_differences.h"
#include "core/mapping/model/correspondence_graph.h"

namespace orbweave {

/// The rotation under which most displacements in metres, in a frame turned somehow, lie as between
/// GNSS positions (reweighted, Cauchy's loss): about the vertical, by what is horizontal, where
/// cameras agree which way is up (UprightFromWorld), so that drives may refer to heights over
/// different datums; else about any axis (Kabsch, Acta Crystallographica 1976), of which what is
/// open about a straight street has no effect on where images are.
///
/// `images`: those that displacements join; nodes of `displacements` are the images of the cluster,
/// and so are `cams_from_world`, in the frame of the displacements.
[[nodiscard]] Eigen::Quaterniond EnuFromDisplacements(
    const ClusterProblem& problem,
    std::span<const ImageSlot> images,
    std::span<const Eigen::Quaterniond> cams_from_world,
    const DifferenceGraph& displacements);

}  // namespace orbweave
