// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/divide_world.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/merging/georeference/global_problem.h"
#include "core/partitioned_ba/assign_tracks.h"

namespace orbweave {
namespace {

/// The images of a world by position, and the position of the subproblem that owns each.
class Owners {
 public:
  Owners(const Reconstruction& scene, const std::map<ImageId, uint32_t>& cluster_of_image) {
    std::map<uint32_t, uint32_t> subproblem_of_cluster;
    for (const auto& [id, image] : scene.images) subproblem_of_cluster[cluster_of_image.at(id)] = 0;
    for (auto& [cluster, subproblem] : subproblem_of_cluster) {
      subproblem = static_cast<uint32_t>(clusters_.size());
      clusters_.push_back(cluster);
    }
    for (const auto& [id, image] : scene.images) {
      images_.push_back(id);
      subproblems_.push_back(subproblem_of_cluster.at(cluster_of_image.at(id)));
    }
  }

  [[nodiscard]] const std::vector<uint32_t>& clusters() const { return clusters_; }
  [[nodiscard]] const std::vector<uint32_t>& subproblem_of_position() const { return subproblems_; }
  [[nodiscard]] uint32_t PositionOf(ImageId id) const {
    return static_cast<uint32_t>(std::ranges::lower_bound(images_, id) - images_.begin());
  }
  [[nodiscard]] uint32_t SubproblemOf(ImageId id) const { return subproblems_[PositionOf(id)]; }

 private:
  std::vector<uint32_t> clusters_;     // per subproblem
  std::vector<ImageId> images_;        // per position
  std::vector<uint32_t> subproblems_;  // per position
};

/// Per track of the scene the subproblem that eliminates it, or kSplitTrack. The held image does
/// not count: its pose is known to all.
std::vector<uint32_t> SubproblemsOfTracks(const Reconstruction& scene,
                                          const Owners& owners,
                                          std::optional<ImageId> held) {
  std::vector<uint32_t> subproblem_of_track(scene.tracks.size());
  std::vector<size_t> crossing;
  std::vector<std::vector<uint32_t>> observers;
  for (size_t t = 0; t < scene.tracks.size(); ++t) {
    std::vector<uint32_t> positions;
    for (const Observation& seen : scene.tracks[t].observations) {
      if (seen.ref.image != held) positions.push_back(owners.PositionOf(seen.ref.image));
    }
    const std::vector<uint32_t>& subproblems = owners.subproblem_of_position();
    subproblem_of_track[t] = subproblems[positions.front()];
    const bool crosses = std::ranges::any_of(positions, [&](uint32_t position) {
      return subproblems[position] != subproblem_of_track[t];
    });
    if (!crosses) continue;
    crossing.push_back(t);
    observers.push_back(std::move(positions));
  }
  const std::vector<uint32_t> assigned = AssignTracks(observers, owners.subproblem_of_position());
  for (size_t i = 0; i < crossing.size(); ++i) subproblem_of_track[crossing[i]] = assigned[i];
  return subproblem_of_track;
}

/// The parts of a track that each owner's images see, by subproblem.
std::map<uint32_t, Track> PartsOf(const Track& track, const Owners& owners) {
  std::map<uint32_t, Track> parts;
  for (const Observation& seen : track.observations) {
    Track& part = parts[owners.SubproblemOf(seen.ref.image)];
    part.point_in_world = track.point_in_world;
    part.color = track.color;
    part.observations.push_back(seen);
  }
  return parts;
}

void DealTracks(Reconstruction& scene,
                const Owners& owners,
                std::optional<ImageId> held,
                std::vector<Subproblem>& subproblems) {
  const std::vector<uint32_t> subproblem_of_track = SubproblemsOfTracks(scene, owners, held);
  uint32_t num_split = 0;
  for (size_t t = 0; t < scene.tracks.size(); ++t) {
    if (subproblem_of_track[t] != kSplitTrack) {
      subproblems[subproblem_of_track[t]].scene.tracks.push_back(std::move(scene.tracks[t]));
      continue;
    }
    for (auto& [subproblem, part] : PartsOf(scene.tracks[t], owners)) {
      subproblems[subproblem].split.push_back({num_split, std::move(part)});
    }
    ++num_split;
  }
}

/// Priors and biases to the subproblems that own their images; a bias is the first user's, and one
/// that there shall not be (its sigma is zero) everybody's.
void DealPriors(const GlobalProblem& problem,
                const Owners& owners,
                std::vector<Subproblem>& subproblems) {
  std::set<uint32_t> counted;
  for (const PositionPrior& prior : problem.bundle.position_priors) {
    const ImageId image = problem.image_of_pose[prior.pose];
    Subproblem& subproblem = subproblems[owners.SubproblemOf(image)];
    subproblem.priors.push_back({.image = image,
                                 .position_in_world = prior.position_in_world,
                                 .sigma_m = prior.sigma_m,
                                 .bias_group = prior.bias_group});
  }
  std::map<uint32_t, uint32_t> times_used;
  std::vector<std::set<uint32_t>> groups(subproblems.size());
  for (size_t b = 0; b < subproblems.size(); ++b) {
    for (const SubproblemPrior& prior : subproblems[b].priors) {
      if (prior.bias_group && groups[b].insert(*prior.bias_group).second)
        ++times_used[*prior.bias_group];
    }
  }
  for (size_t b = 0; b < subproblems.size(); ++b) {
    Subproblem& subproblem = subproblems[b];
    for (const uint32_t group : groups[b]) {
      SubproblemBias& bias = subproblem.biases.emplace_back();
      bias.group = group;
      const double sigma_m = problem.bundle.bias_sigma_m[group];
      bias.is_separator = times_used.at(group) > 1 && sigma_m > 0.0;
      if (counted.insert(group).second || sigma_m == 0.0) bias.sigma_m = sigma_m;
    }
  }
  for (const DirectionPrior& prior : problem.bundle.direction_priors) {
    const ImageId image = problem.image_of_pose[prior.pose];
    subproblems[owners.SubproblemOf(image)].directions.push_back(
        {.image = image,
         .direction_in_world = prior.direction_in_world,
         .direction_in_cam = prior.direction_in_cam,
         .sigma_rad = prior.sigma_rad});
  }
}

struct WorldGauge {
  std::optional<ImageId> held{};
  std::optional<ImageId> farthest{};
};

WorldGauge ChooseWorldGauge(const Reconstruction& scene) {
  WorldGauge gauge;
  double distance = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& [id, image] : scene.images) {
    if (image.loose) continue;
    if (!gauge.held) {
      gauge.held = id;
      centre = image.cam_from_world.Centre();
    }
    const double here = (image.cam_from_world.Centre() - centre).norm();
    if (here <= distance) continue;
    distance = here;
    gauge.farthest = id;
  }
  return gauge;
}

/// The images that a subproblem needs: those it owns, those its tracks see, and the held one beside
/// the farthest.
std::set<ImageId> ImagesOf(const Subproblem& subproblem,
                           const std::vector<ImageId>& owned,
                           const WorldGauge& gauge) {
  std::set<ImageId> images(owned.begin(), owned.end());
  for (const Track& track : subproblem.scene.tracks) {
    for (const Observation& seen : track.observations) images.insert(seen.ref.image);
  }
  if (gauge.farthest && images.contains(*gauge.farthest)) images.insert(*gauge.held);
  return images;
}

void DealImages(const Reconstruction& scene,
                const Owners& owners,
                const WorldGauge& gauge,
                const ImageManifest& manifest,
                std::vector<Subproblem>& subproblems) {
  std::vector<std::vector<ImageId>> owned(subproblems.size());
  for (const auto& [id, image] : scene.images) owned[owners.SubproblemOf(id)].push_back(id);
  std::map<ImageId, uint32_t> times_used;
  std::vector<std::set<ImageId>> images;
  for (size_t b = 0; b < subproblems.size(); ++b) {
    images.push_back(ImagesOf(subproblems[b], owned[b], gauge));
    for (const ImageId id : images.back()) ++times_used[id];
  }
  for (size_t b = 0; b < subproblems.size(); ++b) {
    for (const ImageId id : images[b]) {
      subproblems[b].scene.images[id] = scene.images.at(id);
      const bool is_held = gauge.held == id;
      subproblems[b].images.push_back({.id = id,
                                       .camera = manifest.At(id).camera,
                                       .owner = owners.clusters()[owners.SubproblemOf(id)],
                                       .is_separator = !is_held && times_used.at(id) > 1,
                                       .is_held = is_held});
    }
    if (gauge.farthest && images[b].contains(*gauge.farthest))
      subproblems[b].farthest = gauge.farthest;
  }
}

}  // namespace

void DropLooseObservations(Reconstruction& scene) {
  for (Track& track : scene.tracks) {
    std::erase_if(track.observations, [&](const Observation& seen) {
      const auto image = scene.images.find(seen.ref.image);
      return image == scene.images.end() || image->second.loose;
    });
  }
  std::erase_if(scene.tracks, [](const Track& track) { return track.observations.size() < 2; });
}

std::vector<Subproblem> DivideWorld(Reconstruction scene,
                                    uint32_t world,
                                    const std::map<ImageId, uint32_t>& cluster_of_image,
                                    const Georeference& georeference,
                                    const ImageManifest& manifest,
                                    double bias_sigma_m) {
  DropLooseObservations(scene);
  const Owners owners(scene, cluster_of_image);
  std::vector<Subproblem> subproblems;
  for (const uint32_t cluster : owners.clusters()) {
    subproblems.push_back({.world = world, .cluster = cluster});
  }
  const bool uses_gnss = georeference.enu_from_world.has_value();
  const WorldGauge gauge = uses_gnss ? WorldGauge{} : ChooseWorldGauge(scene);
  DealTracks(scene, owners, gauge.held, subproblems);
  scene.tracks.clear();
  if (uses_gnss) {
    GlobalProblem problem = MakeGlobalProblem(scene);
    AddGnss(scene, manifest, georeference, bias_sigma_m, georeference.gnss_inflation, problem);
    DealPriors(problem, owners, subproblems);
  }
  DealImages(scene, owners, gauge, manifest, subproblems);
  return subproblems;
}

}  // namespace orbweave
