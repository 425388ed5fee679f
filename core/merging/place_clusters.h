// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <vector>

#include "core/base/stage_context.h"
#include "core/merging/alignment/align_options.h"
#include "core/merging/georeference/georeference.h"
#include "core/partitioned_ba/global_options.h"

namespace orbweave {

/// Two clusters of a world that a seam joins, and where it lies.
struct WorldSeam {
  uint32_t cluster_a = 0;
  uint32_t cluster_b = 0;
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
};

/// A world in clusters. References must outlive it.
struct ClusteredWorld {
  const Reconstruction& scene;  ///< poses; tracks take no part
  const std::map<ImageId, uint32_t>& cluster_of_image;
  const std::vector<WorldSeam>& seams;
};

/// Where GNSS puts each cluster: a world of many clusters is no rigid body. Seams are exact to
/// millimetres, but each cluster bends and stretches by a little, which over a thousand of them
/// makes hundreds of metres, where GNSS is off by two.
///
/// Each cluster is fitted to its own positions (GeoreferenceReconstruction), and all together are a
/// graph of similarities: a seam holds two neighbours together as tightly as clusters are stiff
/// (drift.drift_deg, drift.drift_share), least squares; a cluster's fit holds it to the earth as
/// tightly as GNSS scatters, with a robust loss, errors within one cluster taken as one. So
/// positions that jump pull nothing along. A cluster of loose images alone goes where the nearest
/// one along seams does.
///
/// enu_from_world per cluster; empty where one similarity for all (`rigid`) agrees with every
/// cluster's own within three times its scatter, where fewer than 3 clusters have one of their own,
/// seams do not reach all clusters, or most of them end up elsewhere than GNSS says. Deterministic:
/// seeds are derived from the cluster's number. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<std::map<uint32_t, Sim3>> PlaceClusters(const ClusteredWorld& world,
                                                                     const Georeference& rigid,
                                                                     const ImageManifest& manifest,
                                                                     GnssUse use,
                                                                     const AlignOptions& drift,
                                                                     const StageContext& context);

}  // namespace orbweave
