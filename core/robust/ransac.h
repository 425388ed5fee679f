// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/stage_context.h"
#include "core/robust/early_rejection.h"
#include "core/robust/sampling.h"

namespace orbweave {

struct RansacOptions {
  double confidence = 0.9999;
  int min_trials = 1;  ///< drawn even when a good model turns up early
  int max_trials = 10000;
  double min_inlier_share =
      0.0;  ///< models with a smaller share are of no use and may go unnoticed
};

/// Truncated quadratic cost (MSAC): sum over all data of min(r^2, r_max^2). Torr and Zisserman,
/// MLESAC, CVIU 2000.
struct RansacScore {
  double cost = 0.0;
  uint32_t num_inliers = 0;
};

struct RansacReport {
  int num_trials = 0;
  int num_models = 0;       ///< hypotheses that were scored
  int num_refinements = 0;  ///< local optimisations
};

/// What RANSAC needs to know of a problem, all of it over data that the estimator holds:
///   kSampleSize, Model
///   Size()                    number of data
///   Generate(sample, models)  appends the models through a minimal sample of data indices
///   Score(model, gate)        its score, nullopt once `gate` has ruled it out
///   Refine(model)             a better model from the inliers of `model` (local optimisation)
/// Data are in random order (see ShuffledOrder), so that `gate` sees a fair sample first. Where it
/// is known which are likelier to be inliers, BestFirst() has their numbers in that order.
template <typename E>
concept RansacEstimator = requires(const E& estimator,
                                   const typename E::Model& model,
                                   std::span<const uint32_t> sample,
                                   std::vector<typename E::Model>& models,
                                   const EarlyRejection& gate) {
  { E::kSampleSize } -> std::convertible_to<size_t>;
  { estimator.Size() } -> std::convertible_to<size_t>;
  estimator.Generate(sample, models);
  { estimator.Score(model, gate) } -> std::same_as<std::optional<RansacScore>>;
  { estimator.Refine(model) } -> std::same_as<typename E::Model>;
};

template <RansacEstimator E>
[[nodiscard]] std::span<const uint32_t> BestFirstOf(const E& estimator) {
  if constexpr (requires { estimator.BestFirst(); }) {
    return estimator.BestFirst();
  } else {
    return {};
  }
}

template <typename Model>
struct RansacResult {
  std::optional<Model> model{};  ///< nullopt when no sample gave a model
  RansacScore score{};
  RansacReport report{};
};

/// RANSAC with local optimisation (Chum, Matas, Kittler, DAGM 2003): every model that beats the
/// best so far is refined on its inliers. Trials are drawn until a sample free of outliers has been
/// seen with probability options.confidence, given the share of inliers of the best model.
/// Deterministic in context.seed. Cancelled when asked to stop, polled once a trial.
template <RansacEstimator E>
absl::StatusOr<RansacResult<typename E::Model>> Ransac(const E& estimator,
                                                       const RansacOptions& options,
                                                       const StageContext& context) {
  RansacResult<typename E::Model> best;
  const size_t size = estimator.Size();
  if (size < E::kSampleSize) return best;
  SampleSource samples(context.seed, static_cast<uint32_t>(size), BestFirstOf(estimator));
  EarlyRejection gate(size, options.min_inlier_share);
  std::array<uint32_t, E::kSampleSize> sample{};
  std::vector<typename E::Model> models;
  const auto keep_if_better = [&](const typename E::Model& model) {
    ++best.report.num_models;
    const std::optional<RansacScore> score = estimator.Score(model, gate);
    if (!score || (best.model && score->cost >= best.score.cost)) return false;
    best.model = model;
    best.score = *score;
    gate.Raise(score->cost, score->num_inliers);
    return true;
  };
  int trials = options.max_trials;
  for (; best.report.num_trials < trials; ++best.report.num_trials) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    samples.Draw(sample);
    models.clear();
    estimator.Generate(sample, models);
    bool improved = false;
    for (const typename E::Model& model : models) improved |= keep_if_better(model);
    if (!improved) continue;
    ++best.report.num_refinements;
    keep_if_better(estimator.Refine(*best.model));
    const double share = static_cast<double>(best.score.num_inliers) / static_cast<double>(size);
    trials = RequiredTrials(share, E::kSampleSize, options.confidence, options.max_trials);
    trials = std::max(trials, std::min(options.min_trials, options.max_trials));
  }
  return best;
}

}  // namespace orbweave
