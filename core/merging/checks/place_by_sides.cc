// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/merging/checks/place_by_sides.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "core/bundle/bearing_term.h"
#include "core/merging/checks/pose_from_point.h"

namespace orbweave {
namespace {

using Owners = std::map<ImageId, uint32_t>;

Owners OwnersOf(const Subproblem& subproblem) {
  Owners owners;
  for (const SubproblemImage& image : subproblem.images) owners.emplace(image.id, image.owner);
  return owners;
}

/// How many panoramas of each cluster see a track.
std::map<uint32_t, uint32_t> SidesOf(const Track& track, const Owners& owners) {
  std::map<uint32_t, uint32_t> sides;
  for (const Observation& seen : track.observations) ++sides[owners.at(seen.ref.image)];
  return sides;
}

bool IsSeenFromTwoSides(const Track& track, const Owners& owners) {
  const auto owner = [&](const Observation& seen) { return owners.at(seen.ref.image); };
  return std::ranges::adjacent_find(track.observations, std::ranges::not_equal_to{}, owner) !=
         track.observations.end();
}

/// Images whose points are not all their own cluster's, as far as this subproblem can tell: what
/// the others see of a separator or of the held image may be in another subproblem.
std::set<ImageId> ImagesBetweenSides(const Subproblem& subproblem, const Owners& owners) {
  std::set<ImageId> between;
  for (const SubproblemImage& image : subproblem.images) {
    if (image.is_separator || image.is_held) between.insert(image.id);
  }
  for (const Track& track : subproblem.scene.tracks) {
    if (!IsSeenFromTwoSides(track, owners)) continue;
    for (const Observation& seen : track.observations) between.insert(seen.ref.image);
  }
  return between;
}

void AddSighting(const Observation& seen,
                 const Eigen::Vector3d& point_in_world,
                 const Rigid3& cam_from_world,
                 SidePlacement& placement) {
  const BearingTerm term = LineariseBearing(
      cam_from_world.Centre(), point_in_world, cam_from_world.rotation.conjugate() * seen.bearing);
  const double weight = 1.0 / (seen.sigma_rad * seen.sigma_rad);
  const Eigen::Matrix<double, 6, 3> A = PoseFromPoint(term.d);
  placement.hessian += A * PointHessian(term, weight) * A.transpose();
  placement.gradient += A * PointGradient(term, weight);
  ++placement.num_points;
}

}  // namespace

std::vector<SidePlacement> PlaceBySides(const Subproblem& subproblem) {
  const Owners owners = OwnersOf(subproblem);
  const std::set<ImageId> between = ImagesBetweenSides(subproblem, owners);
  std::map<std::pair<ImageId, uint32_t>, SidePlacement> placements;
  for (const Track& track : subproblem.scene.tracks) {
    const bool places_nothing = std::ranges::none_of(
        track.observations,
        [&](const Observation& seen) { return between.contains(seen.ref.image); });
    if (places_nothing) continue;
    const std::map<uint32_t, uint32_t> sides = SidesOf(track, owners);
    for (const Observation& seen : track.observations) {
      const ImageId id = seen.ref.image;
      if (!between.contains(id)) continue;
      for (const auto& [cluster, count] : sides) {
        const uint32_t itself = owners.at(id) == cluster ? 1 : 0;
        if (count - itself < 2) continue;  // the point is not theirs without this image
        SidePlacement& placement = placements[{id, cluster}];
        placement.image = id;
        placement.cluster = cluster;
        AddSighting(
            seen, track.point_in_world, subproblem.scene.images.at(id).cam_from_world, placement);
      }
    }
  }
  std::vector<SidePlacement> sorted;
  for (auto& [key, placement] : placements) sorted.push_back(std::move(placement));
  return sorted;
}

}  // namespace orbweave
