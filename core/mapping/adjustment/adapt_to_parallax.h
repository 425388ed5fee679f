// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mapping/model/correspondence_graph.h"
#include "core/mapping/model/mapping_options.h"

namespace orbweave {

/// How much parallax the matches of a cluster show, radians. Of a feature: the largest angle
/// between its ray and those it is matched with, the rotation of their pair taken off; of an image:
/// what a quarter of its matched features show at least; of the cluster: what a quarter of its
/// images do. 0 without matches. What is far, and panoramas of a stop, do not lower it as long as
/// the others see more.
[[nodiscard]] double ParallaxOf(const ClusterProblem& problem, const CorrespondenceGraph& graph);

/// `options` as they suit images of a camera that hardly moved between the first and the last of
/// them. Of points that are seen under options.min_angle_deg there are hardly any then, and
/// options.max_error_px is more than all that there is to measure. Points are then made under a
/// third of the parallax, half a pixel of the first image at least, and errors are allowed up to
/// what that is in pixels. Where a third of the parallax is options.min_angle_deg or more, and
/// without matches, `options` stay as they are.
[[nodiscard]] MappingOptions AdaptToParallax(const ClusterProblem& problem,
                                             const CorrespondenceGraph& graph,
                                             MappingOptions options);

}  // namespace orbweave
