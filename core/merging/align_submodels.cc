// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/align_submodels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "core/averaging/average_similarities.h"
#include "core/base/parallel_for.h"
#include "core/geometry/rotation.h"
#include "core/merging/find_common_view.h"
#include "core/merging/fit_seam.h"
#include "core/merging/quantile.h"

namespace orbweave {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
// Beyond this the evidence leaves a direction of the similarity open.
constexpr double kMaxCondition = 1e6;
// So many common tracks decide about a seam; with fewer the common images do.
constexpr uint32_t kMinDecidingTracks = 16;
constexpr double kMinAgreeingShare = 0.25;

using FeatureIndexes = std::vector<std::vector<TrackedFeature>>;

struct FittedSeam {
  SeamReport report{};
  std::vector<ImageId> images{};
  SeamFit fit{};
};

// Every two submodels with an image in common.
std::vector<std::pair<uint32_t, uint32_t>> FindSeams(const std::vector<Submodel>& submodels) {
  std::map<ImageId, std::vector<uint32_t>> holders;
  for (uint32_t m = 0; m < submodels.size(); ++m) {
    for (const auto& [id, image] : submodels[m].reconstruction.images) holders[id].push_back(m);
  }
  std::set<std::pair<uint32_t, uint32_t>> seams;
  for (const auto& [id, models] : holders) {
    for (size_t i = 0; i < models.size(); ++i) {
      for (size_t j = i + 1; j < models.size(); ++j) seams.emplace(models[i], models[j]);
    }
  }
  return {seams.begin(), seams.end()};
}

// Why the fit cannot be used; empty when it can.
std::string FindFault(const SeamReport& report, const SeamFit& fit, const AlignOptions& options) {
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

FittedSeam FitOneSeam(const std::vector<Submodel>& submodels,
                      const FeatureIndexes& indexes,
                      std::pair<uint32_t, uint32_t> pair,
                      const AlignOptions& options) {
  const Reconstruction& a = submodels[pair.first].reconstruction;
  const Reconstruction& b = submodels[pair.second].reconstruction;
  const CommonView view = FindCommonView(a, indexes[pair.first], b, indexes[pair.second]);
  FittedSeam seam{.report = {.submodel_a = pair.first, .submodel_b = pair.second},
                  .images = view.images};
  SeamReport& report = seam.report;
  report.common_images = static_cast<uint32_t>(view.images.size());
  report.common_tracks = static_cast<uint32_t>(view.tracks.size());
  if (view.images.empty()) {
    report.used = false;
    report.reason = "all common images are loose";
    return seam;
  }
  seam.fit = FitSeam(GatherSeamEvidence(a, indexes[pair.first], b, view), options.max_error_px);
  report.inlier_tracks = seam.fit.inlier_tracks;
  report.condition_number = seam.fit.condition_number;
  report.reason = FindFault(report, seam.fit, options);
  report.used = report.reason.empty();
  return seam;
}

// Largest distance of a camera centre from a point.
double ExtentFrom(const Eigen::Vector3d& point, const Reconstruction& reconstruction) {
  double extent = 0.0;
  for (const auto& [id, image] : reconstruction.images) {
    extent = std::max(extent, (image.cam_from_world.Centre() - point).norm());
  }
  return extent;
}

double NodeLength(const Reconstruction& reconstruction) {
  if (reconstruction.images.empty()) return 1.0;
  const Eigen::Vector3d first = reconstruction.images.begin()->second.cam_from_world.Centre();
  const double extent = ExtentFrom(first, reconstruction);
  return extent > 0.0 ? extent : 1.0;
}

// Inverse of the fit's covariance plus what the submodels may bend and stretch.
Matrix7d InformationWithDrift(const FittedSeam& seam,
                              const std::vector<Submodel>& submodels,
                              const AlignOptions& options) {
  const SimilarityChart& chart = seam.fit.chart;
  const double extent_a = ExtentFrom(chart.a_from_b * chart.anchor_in_b,
                                     submodels[seam.report.submodel_a].reconstruction);
  const double extent_b =
      chart.a_from_b.scale *
      ExtentFrom(chart.anchor_in_b, submodels[seam.report.submodel_b].reconstruction);
  const double bend = options.drift_deg / kDegPerRad;
  const double stretch = options.drift_share * std::max(extent_a, extent_b) / chart.length_in_a;
  Vector7d variance;
  variance.head<3>().setConstant(bend * bend);
  variance[3] = options.drift_share * options.drift_share;
  variance.tail<3>().setConstant(stretch * stretch);
  Matrix7d covariance = seam.fit.covariance;
  covariance.diagonal() += variance;
  return covariance.inverse();
}

SimilarityGraph MakeGraph(const std::vector<Submodel>& submodels,
                          const std::vector<FittedSeam>& seams,
                          const AlignOptions& options) {
  SimilarityGraph graph;
  for (const Submodel& submodel : submodels) {
    graph.node_length.push_back(NodeLength(submodel.reconstruction));
    graph.node_weight.push_back(static_cast<double>(submodel.reconstruction.images.size()));
  }
  for (const FittedSeam& seam : seams) {
    if (!seam.report.used) continue;
    graph.edges.push_back(
        {.a = seam.report.submodel_a,
         .b = seam.report.submodel_b,
         .measured = seam.fit.chart,
         .information = InformationWithDrift(seam, submodels, options),
         .strength = static_cast<double>(seam.fit.inlier_tracks + seam.fit.inlier_cameras)});
  }
  return graph;
}

// Worlds in order of their number of images (then of their first submodel).
std::vector<uint32_t> RankWorlds(const std::vector<Submodel>& submodels,
                                 const std::vector<uint32_t>& part) {
  std::vector<std::set<ImageId>> images(part.size());
  for (size_t m = 0; m < submodels.size(); ++m) {
    for (const auto& [id, image] : submodels[m].reconstruction.images) images[part[m]].insert(id);
  }
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

void SwitchOffContradicted(const AveragedSimilarities& averaged, std::vector<FittedSeam>& seams) {
  size_t e = 0;
  for (FittedSeam& seam : seams) {
    if (!seam.report.used) continue;
    if (averaged.is_used[e] == 0) {
      seam.report.used = false;
      seam.report.contradicted = true;
      seam.report.reason = "contradicted by loops: off by " +
                           std::to_string(std::lround(averaged.error[e])) +
                           " times the expected drift";
    }
    ++e;
  }
}

void MeasureJumps(const std::vector<Submodel>& submodels,
                  const Alignment& alignment,
                  FittedSeam& seam) {
  const uint32_t a = seam.report.submodel_a;
  const uint32_t b = seam.report.submodel_b;
  if (alignment.world[a] != alignment.world[b]) return;
  std::vector<double> distances;
  std::vector<double> angles_deg;
  for (const ImageId id : seam.images) {
    const Rigid3 from_a = TransformCamera(alignment.world_from_submodel[a],
                                          submodels[a].reconstruction.images.at(id).cam_from_world);
    const Rigid3 from_b = TransformCamera(alignment.world_from_submodel[b],
                                          submodels[b].reconstruction.images.at(id).cam_from_world);
    distances.push_back((from_a.Centre() - from_b.Centre()).norm());
    angles_deg.push_back(kDegPerRad * RotationAngle(from_a.rotation * from_b.rotation.conjugate()));
  }
  seam.report.position_jump_m = Quantile(std::move(distances), 0.5);
  seam.report.rotation_jump_deg = Quantile(std::move(angles_deg), 0.5);
}

}  // namespace

absl::StatusOr<Alignment> AlignSubmodels(const std::vector<Submodel>& submodels,
                                         const AlignOptions& options,
                                         const StageContext& context) {
  FeatureIndexes indexes(submodels.size());
  ParallelFor(submodels.size(), context.num_threads, [&](size_t m) {
    indexes[m] = IndexFeatures(submodels[m].reconstruction);
  });

  const auto pairs = FindSeams(submodels);
  std::vector<FittedSeam> seams(pairs.size());
  ParallelFor(pairs.size(), context.num_threads, [&](size_t s) {
    if (!context.stop.stop_requested()) {
      seams[s] = FitOneSeam(submodels, indexes, pairs[s], options);
    }
  });
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());

  ORBWEAVE_ASSIGN_OR_RETURN(
      AveragedSimilarities averaged,
      AverageSimilarities(
          MakeGraph(submodels, seams, options), {.max_error = options.max_contradiction}, context));
  SwitchOffContradicted(averaged, seams);
  Alignment alignment{.world_from_submodel = std::move(averaged.world_from_node),
                      .world = RankWorlds(submodels, averaged.part)};
  for (const Submodel& submodel : submodels) {
    alignment.submodels.push_back(
        {submodel.cluster, static_cast<uint32_t>(submodel.reconstruction.images.size())});
  }
  for (FittedSeam& seam : seams) {
    MeasureJumps(submodels, alignment, seam);
    alignment.seams.push_back(std::move(seam.report));
  }
  return alignment;
}

}  // namespace orbweave
