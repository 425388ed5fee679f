// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/align_submodels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "core/averaging/average_similarities.h"
#include "core/averaging/similarity_graph.h"
#include "core/base/quantile.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
// Beyond this the evidence leaves a direction of the similarity open.
constexpr double kMaxCondition = 1e6;
// So many common tracks decide about a seam; with fewer the common images do.
constexpr uint32_t kMinDecidingTracks = 16;
constexpr double kMinAgreeingShare = 0.25;

// Loops that do not close may ask for so many times the expected drift: eight degrees, and a sixth
// of the extent, where a place that looks like another is as likely as a submodel that is bent.
constexpr double kMostDrift = 16.0;
// Seams that no loop contains fit exactly.
constexpr double kFits = 1e-3;
constexpr double kLeastSquares = 1e6;

// A seam between submodels known by their position, and what becomes of it.
struct Candidate {
  SeamReport report{};
  const FittedSeam* seam = nullptr;
};

// Why the fit cannot be used; empty when it can.
std::string FindFault(const SeamReport& report, const SeamFit& fit, const AlignOptions& options) {
  if (report.common_images == 0) return "all common images are loose";
  const bool tracks_decide = report.common_tracks >= kMinDecidingTracks;
  if (!tracks_decide && report.common_images < static_cast<uint32_t>(options.min_common_images)) {
    return std::to_string(report.common_images) + " common images and " +
           std::to_string(report.common_tracks) + " common tracks are too few";
  }
  if (tracks_decide && fit.inlier_tracks < kMinAgreeingShare * report.common_tracks) {
    return std::to_string(fit.inlier_tracks) + " of " + std::to_string(report.common_tracks) +
           " common tracks agree";
  }
  if (!tracks_decide && fit.inlier_cameras < static_cast<uint32_t>(options.min_common_images)) {
    return std::to_string(fit.inlier_cameras) + " of " + std::to_string(report.common_images) +
           " common images agree";
  }
  if (fit.condition_number > kMaxCondition) return "the similarity is ill-conditioned";
  return "";
}

Candidate MakeCandidate(const FittedSeam& seam,
                        uint32_t submodel_a,
                        uint32_t submodel_b,
                        const AlignOptions& options) {
  SeamReport report{.submodel_a = submodel_a,
                    .submodel_b = submodel_b,
                    .common_images = static_cast<uint32_t>(seam.shared.size()),
                    .common_tracks = seam.common_tracks,
                    .inlier_tracks = seam.fit.inlier_tracks,
                    .condition_number = seam.fit.condition_number};
  report.reason = FindFault(report, seam.fit, options);
  report.used = report.reason.empty();
  return {std::move(report), &seam};
}

using Outlines = std::vector<const SubmodelOutline*>;

Outlines OutlinesOf(std::span<const SeamsOfCluster> clusters) {
  Outlines outlines;
  for (const SeamsOfCluster& cluster : clusters) {
    for (const SubmodelOutline& outline : cluster.submodels) outlines.push_back(&outline);
  }
  return outlines;
}

// Every submodel once, in the order of their names.
bool AreInOrder(const Outlines& outlines) {
  return std::ranges::adjacent_find(
             outlines, std::ranges::greater_equal{}, &SubmodelOutline::name) == outlines.end();
}

// All seams, sorted by the positions of their submodels.
absl::StatusOr<std::vector<Candidate>> FindCandidates(std::span<const SeamsOfCluster> clusters,
                                                      const Outlines& outlines,
                                                      const AlignOptions& options) {
  std::map<SubmodelName, uint32_t> position;
  for (const SubmodelOutline* outline : outlines)
    position.emplace(outline->name, static_cast<uint32_t>(position.size()));
  std::vector<Candidate> candidates;
  for (const SeamsOfCluster& cluster : clusters) {
    for (const FittedSeam& seam : cluster.seams) {
      const auto a = position.find(seam.a);
      const auto b = position.find(seam.b);
      if (a == position.end() || b == position.end())
        return absl::InvalidArgumentError(
            "align_submodels: a seam of a submodel that is not there");
      candidates.push_back(MakeCandidate(seam, a->second, b->second, options));
    }
  }
  std::ranges::stable_sort(candidates, {}, [](const Candidate& candidate) {
    return std::pair(candidate.report.submodel_a, candidate.report.submodel_b);
  });
  return candidates;
}

// Inverse of the fit's covariance plus what the submodels may bend and stretch.
Matrix7d InformationWithDrift(const FittedSeam& seam,
                              double drift_factor,
                              const AlignOptions& options) {
  const double bend = drift_factor * options.drift_deg / kDegPerRad;
  const double share = drift_factor * options.drift_share;
  const double stretch =
      share * std::max(seam.extent_a, seam.extent_b) / seam.fit.chart.length_in_a;
  Vector7d variance;
  variance.head<3>().setConstant(bend * bend);
  variance[3] = share * share;
  variance.tail<3>().setConstant(stretch * stretch);
  Matrix7d covariance = seam.fit.covariance;
  covariance.diagonal() += variance;
  return covariance.inverse();
}

SimilarityGraph MakeGraph(const Outlines& outlines,
                          const std::vector<Candidate>& candidates,
                          const AlignOptions& options) {
  SimilarityGraph graph;
  for (const SubmodelOutline* outline : outlines) {
    graph.node_length.push_back(outline->length);
    graph.node_weight.push_back(static_cast<double>(outline->images.size()));
  }
  for (const auto& [report, seam] : candidates) {
    if (!report.used) continue;
    graph.edges.push_back(
        {.a = report.submodel_a,
         .b = report.submodel_b,
         .measured = seam->fit.chart,
         .information = InformationWithDrift(*seam, report.drift_factor, options),
         .strength = static_cast<double>(seam->fit.inlier_tracks + seam->fit.inlier_cameras)});
  }
  return graph;
}

// That what is up in b is up in a. `a_from_b` is near what will be found, so that little is left to
// turn about the vertical, of which nothing is said.
SimilarityEdge MakeLevelEdge(const SubmodelLevel& a, const SubmodelLevel& b, Sim3 a_from_b) {
  a_from_b.rotation = RotationBetween(a_from_b.rotation * b.up, a.up) * a_from_b.rotation;
  SimilarityEdge edge{.information = Matrix7d::Zero(), .strength = 0.0, .joins = false};
  edge.measured.a_from_b = a_from_b;
  edge.information.topLeftCorner<3, 3>() = (Eigen::Matrix3d::Identity() - a.up * a.up.transpose()) /
                                           (a.sigma_rad * a.sigma_rad + b.sigma_rad * b.sigma_rad);
  return edge;
}

// That the cameras of bent submodels, those of the parts `bent` of the graph, stand upright, all
// alike: each submodel against the one of its part that knows best which way is up.
void AddLevels(const Outlines& outlines,
               const std::set<uint32_t>& bent,
               const AveragedSimilarities& averaged,
               SimilarityGraph& graph) {
  std::map<uint32_t, uint32_t> best_of_part;
  for (uint32_t m = 0; m < outlines.size(); ++m) {
    if (!outlines[m]->level || !bent.contains(averaged.part[m])) continue;
    uint32_t& best = best_of_part.try_emplace(averaged.part[m], m).first->second;
    if (outlines[m]->level->sigma_rad < outlines[best]->level->sigma_rad) best = m;
  }
  for (uint32_t m = 0; m < outlines.size(); ++m) {
    const auto best = best_of_part.find(averaged.part[m]);
    if (!outlines[m]->level || best == best_of_part.end() || m == best->second) continue;
    SimilarityEdge& edge = graph.edges.emplace_back(MakeLevelEdge(
        *outlines[best->second]->level,
        *outlines[m]->level,
        averaged.world_from_node[best->second].Inverse() * averaged.world_from_node[m]));
    edge.a = best->second;
    edge.b = m;
  }
}

// Takes submodels for as much more bent as their loops say, part by part of the graph where loops
// contradict a seam: by the median of what all seams in loops are off when these share the error.
// Both submodels of a seam have its images, so that their own shape is more in doubt than the seam.
// The parts of which any was.
absl::StatusOr<std::set<uint32_t>> WidenDrift(const Outlines& outlines,
                                              const AveragedSimilarities& averaged,
                                              const AlignOptions& options,
                                              const StageContext& context,
                                              std::vector<Candidate>& candidates) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const AveragedSimilarities shared,
      AverageSimilarities(
          MakeGraph(outlines, candidates, options),
          {.loss_scale = kLeastSquares, .max_error = std::numeric_limits<double>::infinity()},
          context));
  std::map<uint32_t, std::vector<double>> errors_of_part;
  std::set<uint32_t> contradicted;
  size_t e = 0;
  for (const auto& [report, seam] : candidates) {
    if (!report.used) continue;
    const uint32_t part = shared.part[report.submodel_a];
    if (shared.error[e] > kFits) errors_of_part[part].push_back(shared.error[e]);
    if (averaged.is_used[e] == 0) contradicted.insert(part);
    ++e;
  }
  std::set<uint32_t> bent;
  for (auto& [report, seam] : candidates) {
    const uint32_t part = shared.part[report.submodel_a];
    if (!report.used || !contradicted.contains(part)) continue;
    const double drift = Quantile(errors_of_part[part], 0.5);
    if (!(drift > 1.0 && drift <= kMostDrift)) continue;
    report.drift_factor = drift;
    bent.insert(part);
  }
  return bent;
}

// Worlds in order of their number of images (then of their first submodel).
std::vector<uint32_t> RankWorlds(const Outlines& outlines, const std::vector<uint32_t>& part) {
  std::vector<std::set<ImageId>> images(part.size());
  for (size_t m = 0; m < outlines.size(); ++m)
    images[part[m]].insert(outlines[m]->images.begin(), outlines[m]->images.end());
  std::vector<uint32_t> order(part.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t x, uint32_t y) {
    return images[x].size() > images[y].size();
  });
  std::vector<uint32_t> rank(part.size());
  for (uint32_t r = 0; r < order.size(); ++r) rank[order[r]] = r;
  std::vector<uint32_t> world;
  for (const uint32_t p : part) world.push_back(rank[p]);
  return world;
}

void SwitchOffContradicted(const AveragedSimilarities& averaged,
                           std::vector<Candidate>& candidates) {
  size_t e = 0;
  for (auto& [report, seam] : candidates) {
    if (!report.used) continue;
    if (averaged.is_used[e] == 0) {
      report.used = false;
      report.contradicted = true;
      report.reason = "contradicted by loops: off by " +
                      std::to_string(std::lround(averaged.error[e])) + " times the expected drift";
    }
    ++e;
  }
}

void MeasureJumps(const Alignment& alignment, Candidate& candidate) {
  const uint32_t a = candidate.report.submodel_a;
  const uint32_t b = candidate.report.submodel_b;
  if (alignment.world[a] != alignment.world[b]) return;
  std::vector<double> distances;
  std::vector<double> angles_deg;
  for (const FittedSeam::SharedPose& shared : candidate.seam->shared) {
    const Rigid3 from_a = TransformCamera(alignment.world_from_submodel[a], shared.cam_from_a);
    const Rigid3 from_b = TransformCamera(alignment.world_from_submodel[b], shared.cam_from_b);
    distances.push_back((from_a.Centre() - from_b.Centre()).norm());
    angles_deg.push_back(kDegPerRad * RotationAngle(from_a.rotation * from_b.rotation.conjugate()));
  }
  candidate.report.position_jump_m = Quantile(std::move(distances), 0.5);
  candidate.report.rotation_jump_deg = Quantile(std::move(angles_deg), 0.5);
}

}  // namespace

absl::StatusOr<Alignment> AlignSubmodels(std::span<const SeamsOfCluster> clusters,
                                         const AlignOptions& options,
                                         const StageContext& context) {
  const Outlines outlines = OutlinesOf(clusters);
  if (!AreInOrder(outlines))
    return absl::DataLossError("align_submodels: submodels are not in order, or there twice");
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<Candidate> candidates,
                            FindCandidates(clusters, outlines, options));
  const AverageSimilaritiesOptions robust{.max_error = options.max_contradiction};
  ORBWEAVE_ASSIGN_OR_RETURN(
      AveragedSimilarities averaged,
      AverageSimilarities(MakeGraph(outlines, candidates, options), robust, context));
  if (std::ranges::count(averaged.is_used, 0) > 0) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::set<uint32_t> bent,
                              WidenDrift(outlines, averaged, options, context, candidates));
    if (!bent.empty()) {
      SimilarityGraph graph = MakeGraph(outlines, candidates, options);
      ORBWEAVE_ASSIGN_OR_RETURN(averaged, AverageSimilarities(graph, robust, context));
      AddLevels(outlines, bent, averaged, graph);
      ORBWEAVE_ASSIGN_OR_RETURN(averaged, AverageSimilarities(graph, robust, context));
    }
  }
  SwitchOffContradicted(averaged, candidates);
  Alignment alignment{.world_from_submodel = std::move(averaged.world_from_node),
                      .world = RankWorlds(outlines, averaged.part)};
  for (const SubmodelOutline* outline : outlines) {
    alignment.submodels.push_back(
        {outline->name.cluster, static_cast<uint32_t>(outline->images.size())});
  }
  for (Candidate& candidate : candidates) {
    MeasureJumps(alignment, candidate);
    alignment.seams.push_back(std::move(candidate.report));
  }
  return alignment;
}

}  // namespace orbweave
