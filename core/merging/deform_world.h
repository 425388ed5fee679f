// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>

#include "core/merging/place_clusters.h"

namespace orbweave {

/// The world with every cluster where `places` (enu_from_world per cluster, all clusters of the
/// world) puts it, smoothly: an image goes by the mean of the similarities of its own cluster and
/// its neighbours, weighted by exp(-(distance to the cluster's centre / half the distance of
/// neighbouring centres)^2), so that nothing tears where clusters meet. Points are carried along by
/// the images that see them (CarryPoint). One similarity for all is applied exactly.
[[nodiscard]] Reconstruction DeformWorld(Reconstruction scene,
                                         const std::map<ImageId, uint32_t>& cluster_of_image,
                                         const std::vector<WorldSeam>& seams,
                                         const std::map<uint32_t, Sim3>& places);

}  // namespace orbweave
