// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/estimate_depths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/dense/fit_planar_prior.h"
#include "core/dense/interpolate_seeds.h"
#include "core/dense/map_of_planes.h"
#include "core/dense/patch_match.h"
#include "core/dense/random_field.h"
#include "core/dense/trim_edges.h"

namespace orbweave {
namespace {

constexpr float kMostNoise = 40.0F;  // times the least

std::string ProblemOf(const DepthProblem& problem) {
  if (!IsUsable(problem.reference)) return "the image is not 2:1, a multiple of 16 px wide";
  const auto ignored = problem.reference.ignored;
  if (!ignored.empty() && std::ranges::all_of(ignored, [](uint8_t mark) { return mark != 0; })) {
    return "its mask covers all of the image";
  }
  if (!(problem.min_range_m > 0.0) || !(problem.max_range_m > problem.min_range_m)) {
    return "no range of distances to search";
  }
  return "";
}

/// Whether a source is of the reference's size, placed, and somewhere else.
bool IsUsable(const DepthSource& source, const PanoramaRaster& reference) {
  const Rigid3& pose = source.source_from_reference;
  return IsUsable(source.image) && source.image.width_px == reference.width_px &&
         pose.rotation.coeffs().allFinite() && pose.translation.allFinite() &&
         pose.translation.norm() > 1e-6;
}

/// One scale's images of reference and sources.
struct Pyramid {
  GreyPanorama reference{};
  std::vector<GreyPanorama> sources{};
};

Pyramid Half(const Pyramid& full) {
  Pyramid half{HalfPanorama(full.reference)};
  for (const GreyPanorama& source : full.sources) half.sources.push_back(HalfPanorama(source));
  return half;
}

/// Of each scale: halving leaves no more noise than there was; what else its own estimate shows is
/// texture.
std::array<NoiseByLevel, 3> NoiseOf(const std::array<const Pyramid*, 3>& scales,
                                    const DenseOptions& options) {
  const auto least = static_cast<float>(options.noise_levels * options.noise_levels);
  std::array<NoiseByLevel, 3> noise;
  for (size_t k = 0; k < scales.size(); ++k) {
    noise[k] = EstimateNoise(scales[k]->reference, least, kMostNoise * least);
    for (size_t bin = 0; bin < noise[k].variances.size(); ++bin)
      noise[k].variances[bin] = std::min(noise[k].variances[bin], noise[0].variances[bin]);
  }
  return noise;
}

/// What stays the same from scale to scale.
struct Search {
  const DenseOptions& options;
  MatchFunction match;
  std::array<NoiseByLevel, 3> noise{};  ///< after 0, 1, 2 halvings
  RangeLimits limits{};
  uint64_t seed = 0;

  [[nodiscard]] PatchMatchContext At(const MatchScale& scale, const BlockViews& views) const {
    const size_t halvings = static_cast<size_t>(scale.times_halved);
    return {scale, views, options, match, noise[halvings], limits, seed};
  }
};

/// Runs the rounds; returns the sources that the last of them used.
BlockViews RunRounds(const Search& search,
                     const MatchScale& scale,
                     const std::vector<PatchMatchRound>& rounds,
                     PlaneField& field) {
  BlockViews views;
  for (const PatchMatchRound& round : rounds) {
    if (round.views_changed) views = ChooseViews(scale, field, search.options, search.match);
    RunRound(search.At(scale, views), round, field);
  }
  return views;
}

/// Steps and tilts shrink from round to round; `changing`: views are chosen anew for each.
std::vector<PatchMatchRound> PlanRounds(int count, PatchMatchRound first, bool changing) {
  std::vector<PatchMatchRound> rounds;
  for (int k = 0; k < count; ++k) {
    rounds.push_back(first);
    ++first.iteration;
    first.views_changed = changing;
    first.step_px *= 0.5F;
    first.refine_px *= 0.9F;
    first.tilt *= 0.5F;
    first.fresh = std::max(0, first.fresh - 1);
  }
  rounds.back().frees_slopes = true;
  return rounds;
}

constexpr PatchMatchRound kCoarse = {.neighbours = 5,
                                     .fresh = 3,
                                     .level = true,
                                     .perturbed = 3,
                                     .step_px = 4.0F,
                                     .tilt = 0.6F,
                                     .iteration = 0};
constexpr PatchMatchRound kMiddle = {.neighbours = 4,
                                     .level = true,
                                     .perturbed = 2,
                                     .step_px = 2.0F,
                                     .refine_px = 0.8F,
                                     .tilt = 0.3F,
                                     .iteration = 100};
constexpr PatchMatchRound kFine = {.neighbours = 2,
                                   .perturbed = 1,
                                   .step_px = 1.0F,
                                   .refine_px = 0.9F,
                                   .tilt = 0.15F,
                                   .iteration = 200};

PlaneField SearchQuarter(const Search& search,
                         const Pyramid& images,
                         const std::vector<Rigid3>& poses,
                         const std::vector<DepthSeed>& seeds) {
  const MatchScale scale(images.reference, images.sources, poses, 2);
  const std::vector<float> ranges_m = InterpolateSeeds(seeds, scale.raster.face_px, search.seed);
  PlaneField field = RandomField(scale.raster, search.limits, ranges_m, search.seed);
  RunRounds(search, scale, PlanRounds(search.options.coarse_rounds, kCoarse, true), field);
  return field;
}

/// Leaves the planes of the surroundings in `prior`.
PlaneField SearchHalf(const Search& search,
                      const Pyramid& images,
                      const std::vector<Rigid3>& poses,
                      PlaneField field,
                      PlanarPrior& prior) {
  const MatchScale scale(images.reference, images.sources, poses, 1);
  const BlockViews views =
      RunRounds(search, scale, PlanRounds(search.options.middle_rounds, kMiddle, true), field);
  DropSky(search.At(scale, views), field);
  if (!search.options.planar_prior) return field;
  prior = FitPlanarPrior(search.At(scale, views), field);
  TryPrior(search.At(scale, views), prior, field);
  return field;
}

}  // namespace

DepthMap EstimateDepths(const DepthProblem& problem,
                        const DenseOptions& options,
                        MatchKernel kernel) {
  if (const std::string reason = ProblemOf(problem); !reason.empty()) return {.problem = reason};
  std::vector<Rigid3> poses;
  Pyramid full{MakeGreyPanorama(problem.reference)};
  for (const DepthSource& source : problem.sources) {
    if (!IsUsable(source, problem.reference) || poses.size() == kMaxDepthSources) continue;
    poses.push_back(source.source_from_reference);
    full.sources.push_back(MakeGreyPanorama(source.image));
  }
  if (poses.empty()) return {.problem = "no other panorama sees the same place from elsewhere"};
  Pyramid half = Half(full);
  Pyramid quarter = Half(half);
  const Search search{
      options,
      MatchFunctionOf(kernel),
      NoiseOf({&full, &half, &quarter}, options),
      {static_cast<float>(problem.min_range_m), static_cast<float>(problem.max_range_m)},
      problem.seed};
  // What is done with goes: a scale has copies of its own, and memory ends at the finest one.
  PlaneField field = SearchQuarter(search, quarter, poses, problem.seeds);
  quarter = {};
  PlanarPrior prior;
  field = SearchHalf(search, half, poses, DoubleField(field), prior);
  half = {};
  const MatchScale scale(full.reference, full.sources, poses, 0);
  full = {};
  field = DoubleField(field);
  RunRounds(search, scale, PlanRounds(options.fine_rounds, kFine, false), field);
  DepthMap map = MapOfPlanes(scale.raster, field, prior, search.limits, options);
  TrimEdges(scale.raster, field, map);
  if (std::ranges::none_of(map.range_m, [](float range_m) { return range_m > 0.0F; })) {
    return {.problem =
                "nothing in it is found in other panoramas at any distance: it shows the sky "
                "alone, or surfaces without texture"};
  }
  return map;
}

DepthMap EstimateDepths(const DepthProblem& problem, const DenseOptions& options) {
  return EstimateDepths(problem, options, AvailableMatchKernels().back());
}

}  // namespace orbweave
