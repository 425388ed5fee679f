// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/deform_world.h"

#include <cmath>
#include <utility>
#include <vector>

#include "core/geometry/rotation.h"
#include "core/merging/carry_point.h"
#include "core/merging/georeference/cluster_spreads.h"

namespace orbweave {
namespace {

struct PlacedCluster {
  Sim3 enu_from_world{};
  Eigen::Vector3d centre_in_world = Eigen::Vector3d::Zero();
  double reach = 1.0;                     // half the mean distance of the neighbours' centres
  std::vector<uint32_t> near_clusters{};  // itself first
};

using PlacedClusters = std::map<uint32_t, PlacedCluster>;

PlacedClusters PlaceAll(const Reconstruction& scene,
                        const std::map<ImageId, uint32_t>& cluster_of_image,
                        const std::vector<WorldSeam>& seams,
                        const std::map<uint32_t, Sim3>& places) {
  PlacedClusters clusters;
  for (const auto& [cluster, enu_from_world] : places) {
    clusters[cluster].enu_from_world = enu_from_world;
    clusters[cluster].near_clusters.push_back(cluster);
  }
  for (const auto& [cluster, spread] : ClusterSpreads(scene, cluster_of_image))
    clusters.at(cluster).centre_in_world = spread.centre;
  for (const WorldSeam& seam : seams) {
    if (!clusters.contains(seam.cluster_a) || !clusters.contains(seam.cluster_b)) continue;
    clusters[seam.cluster_a].near_clusters.push_back(seam.cluster_b);
    clusters[seam.cluster_b].near_clusters.push_back(seam.cluster_a);
  }
  for (auto& [cluster, placed] : clusters) {
    double sum = 0.0;
    for (const uint32_t other : placed.near_clusters)
      sum += (clusters[other].centre_in_world - placed.centre_in_world).norm();
    if (sum > 0.0) placed.reach = 0.5 * sum / static_cast<double>(placed.near_clusters.size() - 1);
  }
  return clusters;
}

// The mean similarity at a point of a cluster, as one that maps the point where the mean does.
Sim3 MeanAt(const Eigen::Vector3d& point, uint32_t cluster, const PlacedClusters& clusters) {
  const PlacedCluster& own = clusters.at(cluster);
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  double log_scale = 0.0;
  double total = 0.0;
  for (const uint32_t other : own.near_clusters) {
    const PlacedCluster& placed = clusters.at(other);
    const double distance = (point - placed.centre_in_world).norm() / placed.reach;
    // Never zero: far from all centres the own cluster decides.
    const double weight = std::exp(-distance * distance) + (other == cluster ? 1e-12 : 0.0);
    const Sim3& place = placed.enu_from_world;
    position += weight * (place * point);
    turn += weight * VectorFromRotation(place.rotation * own.enu_from_world.rotation.conjugate());
    log_scale += weight * std::log(place.scale);
    total += weight;
  }
  Sim3 mean{
      .scale = std::exp(log_scale / total),
      .rotation = (RotationFromVector(turn / total) * own.enu_from_world.rotation).normalized()};
  mean.translation = position / total - mean * point;
  return mean;
}

}  // namespace

Reconstruction DeformWorld(Reconstruction scene,
                           const std::map<ImageId, uint32_t>& cluster_of_image,
                           const std::vector<WorldSeam>& seams,
                           const std::map<uint32_t, Sim3>& places) {
  const PlacedClusters clusters = PlaceAll(scene, cluster_of_image, seams, places);
  std::map<ImageId, RegisteredImage> bent = scene.images;
  std::map<ImageId, double> scale_of_image;
  for (auto& [id, image] : bent) {
    const Sim3 mean = MeanAt(image.cam_from_world.Centre(), cluster_of_image.at(id), clusters);
    image.cam_from_world = TransformCamera(mean, image.cam_from_world);
    scale_of_image[id] = mean.scale;
  }
  for (Track& track : scene.tracks) {
    const double scale = scale_of_image.at(track.observations.front().ref.image);
    if (const auto point = CarryPoint(track, scene.images, bent, scale))
      track.point_in_world = *point;
  }
  scene.images = std::move(bent);
  return scene;
}

}  // namespace orbweave
