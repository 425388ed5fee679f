// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/place_clusters.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "core/averaging/solve_similarity_graph.h"
#include "core/base/parallel_for.h"
#include "core/base/quantile.h"
#include "core/merging/georeference/cluster_spreads.h"
#include "core/merging/georeference/estimate_gravity.h"
#include "core/merging/georeference/georeference_reconstruction.h"

namespace orbweave {
namespace {

constexpr size_t kMinFits = 3;
constexpr double kMaxError = 3.0;
constexpr double kMinAgreeingShare = 0.7;
constexpr double kLossScale = 3.0;
constexpr double kRadPerDeg = std::numbers::pi / 180.0;

// A cluster in a frame of its own: the world's axes and scale, its centre as origin.
struct Node {
  uint32_t cluster = 0;
  Reconstruction images{};
  Eigen::Vector3d centre_in_world = Eigen::Vector3d::Zero();
  double extent = 1.0;
  std::optional<Sim3> enu_from_node{};  // its own fit
  double sigma_m = 0.0;                 // of that fit, along an axis
  bool knows_height = false;            // of any of its positions
};

std::vector<Node> MakeNodes(const ClusteredWorld& world) {
  std::map<uint32_t, Node> nodes;
  for (const auto& [id, image] : world.scene.images) {
    if (image.loose) continue;
    nodes[world.cluster_of_image.at(id)].images.images.emplace(id, image);
  }
  const std::map<uint32_t, Spread> spreads = ClusterSpreads(world.scene, world.cluster_of_image);
  std::vector<Node> list;
  for (auto& [cluster, node] : nodes) {
    node.cluster = cluster;
    const Spread& spread = spreads.at(cluster);
    node.centre_in_world = spread.centre;
    node.images = Transformed({.translation = -node.centre_in_world}, std::move(node.images));
    if (spread.rms > 0.0) node.extent = spread.rms;
    list.push_back(std::move(node));
  }
  return list;
}

double TypicalSigma(const Reconstruction& images, const ImageManifest& manifest) {
  std::vector<double> sigmas;
  for (const auto& [id, image] : images.images) {
    const PosePrior& prior = manifest.At(id).prior;
    if (prior.position_in_enu) sigmas.push_back(prior.horizontal_sigma_m);
  }
  return Quantile(std::move(sigmas), 0.5);
}

bool KnowsHeight(const Reconstruction& images, const ImageManifest& manifest) {
  return std::ranges::any_of(images.images, [&](const auto& image) {
    const PosePrior& prior = manifest.At(image.first).prior;
    return prior.position_in_enu && IsHeightKnown(prior.vertical_sigma_m);
  });
}

absl::Status FitNode(const ImageManifest& manifest,
                     GnssUse use,
                     const StageContext& context,
                     Node& node) {
  StageContext own = context;
  own.num_threads = 1;
  own.seed ^= 0x9E3779B97F4A7C15ULL * (node.cluster + 1);
  ORBWEAVE_ASSIGN_OR_RETURN(const Georeference fit,
                            GeoreferenceReconstruction(node.images, manifest, use, own));
  node.enu_from_node = fit.enu_from_world;
  node.sigma_m = std::max(fit.horizontal_scatter_m, TypicalSigma(node.images, manifest));
  node.knows_height = KnowsHeight(node.images, manifest);
  return absl::OkStatus();
}

absl::Status FitNodes(const ImageManifest& manifest,
                      GnssUse use,
                      const StageContext& context,
                      std::vector<Node>& nodes) {
  std::vector<absl::Status> statuses(nodes.size());
  ParallelFor(nodes.size(), context.num_threads, [&](size_t n) {
    statuses[n] = FitNode(manifest, use, context, nodes[n]);
  });
  for (const absl::Status& status : statuses) ORBWEAVE_RETURN_IF_ERROR(status);
  return absl::OkStatus();
}

// Whether one similarity puts every cluster where its own does.
bool IsRigid(const std::vector<Node>& nodes, const Georeference& rigid) {
  if (!rigid.enu_from_world) return false;
  return std::ranges::all_of(nodes, [&](const Node& node) {
    if (!node.enu_from_node) return true;
    const Eigen::Vector3d gap =
        *rigid.enu_from_world * node.centre_in_world - node.enu_from_node->translation;
    return gap.head<2>().norm() <= kMaxError * node.sigma_m;
  });
}

Matrix7d InformationOf(const Vector7d& sigma) {
  return sigma.cwiseAbs2().cwiseInverse().asDiagonal();
}

// Node 0 is the earth, node n + 1 is nodes[n].
SimilarityEdge EdgeToEarth(const Node& node, uint32_t number) {
  const double extent_m = node.enu_from_node->scale * node.extent;
  const double share = node.sigma_m / extent_m;
  Vector7d sigma = Vector7d::Constant(share);
  sigma.head<2>().setConstant(kMountSigma_rad);
  if (!node.knows_height) sigma[6] = kUnknownHeightSigma_m / extent_m;
  return {.a = 0,
          .b = number,
          .measured = {.a_from_b = *node.enu_from_node, .length_in_a = extent_m},
          .information = InformationOf(sigma)};
}

SimilarityEdge EdgeOfSeam(const WorldSeam& seam,
                          std::pair<uint32_t, uint32_t> numbers,
                          const Node& a,
                          const Node& b,
                          const AlignOptions& drift) {
  Vector7d sigma = Vector7d::Constant(drift.drift_share);
  sigma.head<3>().setConstant(kRadPerDeg * drift.drift_deg);
  return {.a = numbers.first,
          .b = numbers.second,
          .measured = {.a_from_b = {.translation = b.centre_in_world - a.centre_in_world},
                       .anchor_in_b = seam.position_in_world - b.centre_in_world,
                       .length_in_a = std::max(a.extent, b.extent)},
          .information = InformationOf(sigma),
          .is_certain = true};
}

struct EarthGraph {
  SimilarityGraph graph{};
  size_t num_seams = 0;  // the first edges
};

EarthGraph MakeGraph(const std::vector<Node>& nodes,
                     const std::vector<WorldSeam>& seams,
                     const AlignOptions& drift) {
  EarthGraph earth;
  earth.graph.node_length.push_back(1.0);
  std::map<uint32_t, uint32_t> number_of_cluster;
  for (const Node& node : nodes) {
    earth.graph.node_length.push_back(node.extent);
    const auto number = static_cast<uint32_t>(number_of_cluster.size() + 1);
    number_of_cluster.emplace(node.cluster, number);
  }
  for (const WorldSeam& seam : seams) {
    const auto a = number_of_cluster.find(seam.cluster_a);
    const auto b = number_of_cluster.find(seam.cluster_b);
    if (a == number_of_cluster.end() || b == number_of_cluster.end()) continue;
    earth.graph.edges.push_back(EdgeOfSeam(
        seam, {a->second, b->second}, nodes[a->second - 1], nodes[b->second - 1], drift));
  }
  earth.num_seams = earth.graph.edges.size();
  for (uint32_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].enu_from_node) earth.graph.edges.push_back(EdgeToEarth(nodes[n], n + 1));
  }
  return earth;
}

// Every node's own fit, or that of the nearest along seams; nullopt where seams do not reach.
std::optional<std::vector<Sim3>> StartFrom(const std::vector<Node>& nodes,
                                           const EarthGraph& earth) {
  std::vector<std::vector<size_t>> seams_of(nodes.size() + 1);
  for (size_t e = 0; e < earth.num_seams; ++e) {
    seams_of[earth.graph.edges[e].a].push_back(e);
    seams_of[earth.graph.edges[e].b].push_back(e);
  }
  std::vector<Sim3> start(nodes.size() + 1);
  std::vector<uint8_t> is_placed(nodes.size() + 1, 0);
  std::vector<size_t> reached;
  for (size_t n = 0; n < nodes.size(); ++n) {
    if (!nodes[n].enu_from_node) continue;
    start[n + 1] = *nodes[n].enu_from_node;
    is_placed[n + 1] = 1;
    reached.push_back(n + 1);
  }
  for (size_t next = 0; next < reached.size(); ++next) {
    const size_t from = reached[next];
    for (const size_t e : seams_of[from]) {
      const SimilarityEdge& seam = earth.graph.edges[e];
      const size_t to = seam.a == from ? seam.b : seam.a;
      if (is_placed[to] != 0) continue;
      const Sim3& a_from_b = seam.measured.a_from_b;
      start[to] = start[from] * (seam.a == from ? a_from_b : a_from_b.Inverse());
      is_placed[to] = 1;
      reached.push_back(to);
    }
  }
  if (reached.size() < nodes.size()) return std::nullopt;
  return start;
}

// Clusters without a place, as nothing but loose images is left of them, go where the nearest one
// along seams does. False when seams lead from one of them to none that has a place.
bool FollowNeighbours(const ClusteredWorld& world, std::map<uint32_t, Sim3>& places) {
  std::set<uint32_t> left;
  for (const auto& [id, image] : world.scene.images) {
    const uint32_t cluster = world.cluster_of_image.at(id);
    if (!places.contains(cluster)) left.insert(cluster);
  }
  while (!left.empty()) {
    std::map<uint32_t, Sim3> ring;
    for (const WorldSeam& seam : world.seams) {
      const uint32_t a = seam.cluster_a;
      const uint32_t b = seam.cluster_b;
      if (left.contains(a) && places.contains(b)) ring.emplace(a, places.at(b));
      if (left.contains(b) && places.contains(a)) ring.emplace(b, places.at(a));
    }
    if (ring.empty()) return false;
    for (const auto& [cluster, place] : ring) left.erase(cluster);
    places.merge(ring);
  }
  return true;
}

bool AgreesWithGnss(const std::vector<double>& errors, size_t num_seams) {
  const auto agreeing = std::count_if(errors.begin() + static_cast<std::ptrdiff_t>(num_seams),
                                      errors.end(),
                                      [](double error) { return error <= kMaxError; });
  return static_cast<double>(agreeing) >=
         kMinAgreeingShare * static_cast<double>(errors.size() - num_seams);
}

}  // namespace

absl::StatusOr<std::map<uint32_t, Sim3>> PlaceClusters(const ClusteredWorld& world,
                                                       const Georeference& rigid,
                                                       const ImageManifest& manifest,
                                                       GnssUse use,
                                                       const AlignOptions& drift,
                                                       const StageContext& context) {
  std::map<uint32_t, Sim3> places;
  if (use == GnssUse::kOff) return places;
  std::vector<Node> nodes = MakeNodes(world);
  if (nodes.size() < kMinFits) return places;
  ORBWEAVE_RETURN_IF_ERROR(FitNodes(manifest, use, context, nodes));
  const auto num_fits =
      std::ranges::count_if(nodes, [](const Node& node) { return node.enu_from_node.has_value(); });
  if (static_cast<size_t>(num_fits) < kMinFits || IsRigid(nodes, rigid)) return places;

  const EarthGraph earth = MakeGraph(nodes, world.seams, drift);
  const std::optional<std::vector<Sim3>> start = StartFrom(nodes, earth);
  if (!start) return places;
  std::vector<uint8_t> is_fixed(nodes.size() + 1, 0);
  is_fixed[0] = 1;
  const SimilaritySolver solver(earth.graph, is_fixed);
  ORBWEAVE_ASSIGN_OR_RETURN(
      const SimilaritySolution solution,
      solver.Solve(*start, std::vector<uint8_t>(earth.graph.edges.size(), 1), kLossScale, context));
  if (!AgreesWithGnss(solver.Errors(solution.world_from_node), earth.num_seams)) return places;
  for (size_t n = 0; n < nodes.size(); ++n) {
    places[nodes[n].cluster] =
        solution.world_from_node[n + 1] * Sim3{.translation = -nodes[n].centre_in_world};
  }
  if (!FollowNeighbours(world, places)) places.clear();
  return places;
}

}  // namespace orbweave
