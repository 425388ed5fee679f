// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/fit_seams.h"

#include <algorithm>
#include <utility>

#include "core/base/parallel_for.h"
#include "core/merging/alignment/find_common_view.h"

namespace orbweave {
namespace {

struct IndexedSubmodel {
  const Submodel* submodel = nullptr;
  std::vector<TrackedFeature> features{};
};

// Positions in the list of all submodels, a < b.
using SubmodelPair = std::pair<size_t, size_t>;

bool HaveCommonImage(const Reconstruction& a, const Reconstruction& b) {
  return std::ranges::any_of(a.images,
                             [&](const auto& image) { return b.images.contains(image.first); });
}

// Those with a common image of which the first is among the first `num_own`.
std::vector<SubmodelPair> FindPairs(const std::vector<IndexedSubmodel>& submodels, size_t num_own) {
  std::vector<SubmodelPair> pairs;
  for (size_t a = 0; a < num_own; ++a) {
    for (size_t b = a + 1; b < submodels.size(); ++b) {
      if (HaveCommonImage(submodels[a].submodel->reconstruction,
                          submodels[b].submodel->reconstruction))
        pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

// Largest distance of a camera centre from a point.
double ExtentFrom(const Eigen::Vector3d& point, const Reconstruction& reconstruction) {
  double extent = 0.0;
  for (const auto& [id, image] : reconstruction.images) {
    extent = std::max(extent, (image.cam_from_world.Centre() - point).norm());
  }
  return extent;
}

SubmodelOutline OutlineOf(const Submodel& submodel) {
  SubmodelOutline outline{.name = submodel.name()};
  const auto& images = submodel.reconstruction.images;
  std::vector<Eigen::Quaterniond> cams_from_submodel;
  for (const auto& [id, image] : images) {
    outline.images.push_back(id);
    if (!image.loose) cams_from_submodel.push_back(image.cam_from_world.rotation);
  }
  if (images.empty()) return outline;
  outline.level = LevelOf(cams_from_submodel);
  const double extent =
      ExtentFrom(images.begin()->second.cam_from_world.Centre(), submodel.reconstruction);
  if (extent > 0.0) outline.length = extent;
  return outline;
}

FittedSeam FitPair(const IndexedSubmodel& first, const IndexedSubmodel& second, double max_error) {
  const Reconstruction& a = first.submodel->reconstruction;
  const Reconstruction& b = second.submodel->reconstruction;
  const CommonView view = FindCommonView(a, first.features, b, second.features);
  FittedSeam seam{.a = first.submodel->name(),
                  .b = second.submodel->name(),
                  .common_tracks = static_cast<uint32_t>(view.tracks.size())};
  for (const ImageId id : view.images) {
    seam.shared.push_back({a.images.at(id).cam_from_world, b.images.at(id).cam_from_world});
  }
  if (view.images.empty()) return seam;
  seam.fit = FitSeam(GatherSeamEvidence(a, first.features, b, view), max_error);
  const SimilarityChart& chart = seam.fit.chart;
  seam.extent_a = ExtentFrom(chart.a_from_b * chart.anchor_in_b, a);
  seam.extent_b = chart.a_from_b.scale * ExtentFrom(chart.anchor_in_b, b);
  return seam;
}

}  // namespace

absl::StatusOr<SeamsOfCluster> FitSeams(std::span<const Submodel> own,
                                        std::span<const Submodel> later,
                                        double max_error,
                                        const StageContext& context) {
  std::vector<IndexedSubmodel> submodels;
  for (const Submodel& submodel : own) submodels.push_back({&submodel});
  for (const Submodel& submodel : later) submodels.push_back({&submodel});
  ParallelFor(submodels.size(), context.num_threads, [&](size_t m) {
    submodels[m].features = IndexFeatures(submodels[m].submodel->reconstruction);
  });
  const std::vector<SubmodelPair> pairs = FindPairs(submodels, own.size());
  SeamsOfCluster result{.seams = std::vector<FittedSeam>(pairs.size())};
  for (const Submodel& submodel : own) result.submodels.push_back(OutlineOf(submodel));
  ParallelFor(pairs.size(), context.num_threads, [&](size_t s) {
    if (context.stop.stop_requested()) return;
    const auto [a, b] = pairs[s];
    result.seams[s] = FitPair(submodels[a], submodels[b], max_error);
  });
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  return result;
}

}  // namespace orbweave
