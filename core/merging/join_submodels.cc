// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/join_submodels.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/estimators/estimate_similarity.h"
#include "core/merging/carry_point.h"
#include "core/merging/deform_world.h"
#include "core/merging/divide_world.h"
#include "core/merging/georeference/georeference_reconstruction.h"
#include "core/merging/georeference/global_problem.h"
#include "core/merging/place_clusters.h"

namespace orbweave {
namespace {

/// Per world the cluster that answers for each image: the one whose interior it is in, where that
/// has it, else the first that has it.
std::vector<std::map<ImageId, uint32_t>> OwnersInWorlds(const std::vector<Submodel>& boundaries,
                                                        const Alignment& alignment,
                                                        const Partition& partition) {
  std::vector<std::map<ImageId, uint32_t>> owners;
  for (size_t m = 0; m < boundaries.size(); ++m) {
    const uint32_t world = alignment.world[m];
    if (world >= owners.size()) owners.resize(world + 1);
    const std::vector<ImageId>& interior = partition.clusters[boundaries[m].cluster].interior;
    for (const auto& [id, image] : boundaries[m].reconstruction.images) {
      const auto [owner, is_new] = owners[world].emplace(id, boundaries[m].cluster);
      if (std::ranges::binary_search(interior, id)) owner->second = boundaries[m].cluster;
    }
  }
  std::erase_if(owners, [](const auto& of_world) { return of_world.empty(); });
  return owners;
}

using SubmodelsOfCluster = std::map<uint32_t, std::vector<PlacedSubmodel>>;

/// Per world and cluster where its submodels lie in the frame that the alignment chose.
std::vector<SubmodelsOfCluster> PlaceSubmodels(const std::vector<Submodel>& boundaries,
                                               const Alignment& alignment) {
  std::vector<SubmodelsOfCluster> placed;
  for (size_t m = 0; m < boundaries.size(); ++m) {
    const uint32_t world = alignment.world[m];
    if (world >= placed.size()) placed.resize(world + 1);
    if (boundaries[m].reconstruction.images.empty()) continue;
    placed[world][boundaries[m].cluster].push_back(
        {.submodel = boundaries[m].submodel,
         .world_from_submodel = alignment.world_from_submodel[m]});
  }
  std::erase_if(placed, [](const auto& of_world) { return of_world.empty(); });
  return placed;
}

/// The seams of a world that the alignment used, where their images lie.
std::vector<WorldSeam> SeamsOf(uint32_t world,
                               const Reconstruction& scene,
                               const Alignment& alignment,
                               const Partition& partition) {
  std::set<std::pair<uint32_t, uint32_t>> used;
  for (const SeamReport& seam : alignment.seams) {
    if (!seam.used || alignment.world[seam.submodel_a] != world) continue;
    used.emplace(alignment.submodels[seam.submodel_a].cluster,
                 alignment.submodels[seam.submodel_b].cluster);
  }
  std::vector<WorldSeam> seams;
  for (const Seam& seam : partition.seams) {
    if (!used.contains({seam.cluster_a, seam.cluster_b})) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (const ImageId id : seam.shared) {
      const auto image = scene.images.find(id);
      if (image == scene.images.end() || image->second.loose) continue;
      sum += image->second.cam_from_world.Centre();
      count += 1.0;
    }
    if (count > 0.0) seams.push_back({seam.cluster_a, seam.cluster_b, sum / count});
  }
  return seams;
}

/// A world in east-north-up metres where GNSS allows, and how its clusters came there.
struct PlacedWorld {
  Reconstruction scene{};
  Georeference georeference{};
  std::map<uint32_t, Sim3> enu_from_world{};  ///< per cluster; others by `for_others`
  Sim3 for_others{};

  [[nodiscard]] const Sim3& Of(uint32_t cluster) const {
    const auto found = enu_from_world.find(cluster);
    return found == enu_from_world.end() ? for_others : found->second;
  }
};

/// The largest distance of an image from where one similarity would put it.
double BendOf(const Reconstruction& before, const Reconstruction& after) {
  std::vector<Eigen::Vector3d> from;
  std::vector<Eigen::Vector3d> to;
  for (const auto& [id, image] : before.images) {
    if (image.loose) continue;
    from.push_back(image.cam_from_world.Centre());
    to.push_back(after.images.at(id).cam_from_world.Centre());
  }
  const std::optional<Sim3> rigid = FitSimilarity(from, to, {});
  double largest = 0.0;
  if (!rigid) return largest;
  for (size_t i = 0; i < from.size(); ++i)
    largest = std::max(largest, (*rigid * from[i] - to[i]).norm());
  return largest;
}

absl::StatusOr<PlacedWorld> PlaceWorld(Reconstruction scene,
                                       const std::map<ImageId, uint32_t>& owners,
                                       const std::vector<WorldSeam>& seams,
                                       const ImageManifest& manifest,
                                       GnssUse use,
                                       const AlignOptions& align,
                                       const StageContext& context) {
  PlacedWorld placed;
  ORBWEAVE_ASSIGN_OR_RETURN(placed.georeference,
                            GeoreferenceReconstruction(scene, manifest, use, context));
  ORBWEAVE_ASSIGN_OR_RETURN(placed.enu_from_world,
                            PlaceClusters({scene, owners, seams},
                                          placed.georeference,
                                          WithoutDriveErrors(scene, manifest, placed.georeference),
                                          use,
                                          align,
                                          context));
  if (!placed.enu_from_world.empty()) {
    const Reconstruction straight{.images = scene.images};
    scene = DeformWorld(std::move(scene), owners, seams, placed.enu_from_world);
    ORBWEAVE_ASSIGN_OR_RETURN(placed.georeference,
                              GeoreferenceReconstruction(scene, manifest, use, context));
    placed.georeference.deformation_m = BendOf(straight, scene);
  }
  if (placed.georeference.enu_from_world) {
    const Sim3& enu_from_scene = *placed.georeference.enu_from_world;
    scene = Transformed(enu_from_scene, std::move(scene));
    for (auto& [cluster, place] : placed.enu_from_world) place = enu_from_scene * place;
    placed.for_others = enu_from_scene;
  }
  placed.scene = std::move(scene);
  return placed;
}

}  // namespace

absl::StatusOr<JoinedSubmodels> JoinSubmodels(std::vector<Submodel> boundaries,
                                              const Alignment& alignment,
                                              const Partition& partition,
                                              const ImageManifest& manifest,
                                              const AlignOptions& align,
                                              const GlobalAdjustOptions& options,
                                              const StageContext& context) {
  const auto owners = OwnersInWorlds(boundaries, alignment, partition);
  const auto submodels = PlaceSubmodels(boundaries, alignment);
  JoinedSubmodels joined;
  for (MergedWorld& merged : MergeSubmodels(std::move(boundaries), alignment)) {
    const auto number = static_cast<uint32_t>(joined.worlds.size());
    JoinedWorld world{.merge = merged.report,
                      .num_images = static_cast<uint32_t>(merged.reconstruction.images.size())};
    const std::vector<WorldSeam> seams =
        SeamsOf(number, merged.reconstruction, alignment, partition);
    ORBWEAVE_ASSIGN_OR_RETURN(PlacedWorld placed,
                              PlaceWorld(std::move(merged.reconstruction),
                                         owners[number],
                                         seams,
                                         manifest,
                                         options.gnss,
                                         align,
                                         context));
    for (Subproblem& subproblem : DivideWorld(std::move(placed.scene),
                                              number,
                                              owners[number],
                                              placed.georeference,
                                              manifest,
                                              options.gnss_bias_sigma_m)) {
      JoinedSubproblem& whole = joined.subproblems.emplace_back();
      whole.submodels = submodels[number].at(subproblem.cluster);
      for (PlacedSubmodel& submodel : whole.submodels)
        submodel.world_from_submodel = placed.Of(subproblem.cluster) * submodel.world_from_submodel;
      whole.subproblem = std::move(subproblem);
      ++world.num_subproblems;
    }
    world.georeference = std::move(placed.georeference);
    joined.worlds.push_back(std::move(world));
  }
  return joined;
}

Subproblem AssembleSubproblem(JoinedSubproblem joined, std::vector<Reconstruction> inner) {
  ORBWEAVE_CHECK(inner.size() == joined.submodels.size());
  Subproblem subproblem = std::move(joined.subproblem);
  for (size_t i = 0; i < inner.size(); ++i) {
    const Sim3& world_from_submodel = joined.submodels[i].world_from_submodel;
    for (Track& track : inner[i].tracks) {
      track.point_in_world =
          CarryPoint(track, inner[i].images, subproblem.scene.images, world_from_submodel.scale)
              .value_or(world_from_submodel * track.point_in_world);
      subproblem.scene.tracks.push_back(std::move(track));
    }
  }
  DropLooseObservations(subproblem.scene);
  subproblem.scene.SortTracks();
  return subproblem;
}

}  // namespace orbweave
