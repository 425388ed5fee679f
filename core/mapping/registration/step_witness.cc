// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/step_witness.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/quantile.h"
#include "core/base/shortest_half.h"
#include "core/mapping/registration/gnss_steps.h"

namespace orbweave {
namespace {

constexpr size_t kMaxImages = 30;
constexpr size_t kMaxSteps = 5;
constexpr size_t kFewestSteps = 2;
/// The unit of the model is known to a twentieth at best, from so few steps.
constexpr double kUnitShare = 0.05;

/// Registered images that pairs lead to from `image`, without it, the fewest pairs away first.
std::vector<ImageSlot> ImagesAround(const MappingState& state, ImageSlot image) {
  const CorrespondenceGraph& graph = state.Graph();
  std::vector<ImageSlot> found = {image};
  for (size_t i = 0; i < found.size(); ++i) {
    for (const uint32_t p : graph.pairs_of_image[found[i]]) {
      const LinkedPair& pair = graph.pairs[p];
      const ImageSlot other = pair.a == found[i] ? pair.b : pair.a;
      if (!state.IsRegistered(other) || std::ranges::count(found, other) > 0) continue;
      found.push_back(other);
      if (found.size() > kMaxImages) return {found.begin() + 1, found.end()};
    }
  }
  return {found.begin() + 1, found.end()};
}

struct StepSample {
  double length = 0.0;  ///< in the model
  double length_m = 0.0;
  double sigma_m = 0.0;
  bool is_within_drive = false;
};

bool AreOfOneDrive(const MappingState& state, ImageSlot a, ImageSlot b) {
  return state.Problem().images[a].drive == state.Problem().images[b].drive;
}

StepSample SampleOf(const MappingState& state, ImageSlot a, ImageSlot b) {
  const GnssStep step = StepBetween(state.Problem(), a, b);
  const double length_m = std::exp(step.log_length);
  return {.length = (state.Centre(b) - state.Centre(a)).norm(),
          .length_m = length_m,
          .sigma_m = step.sigma * length_m,
          .is_within_drive = AreOfOneDrive(state, a, b)};
}

std::vector<StepSample> StepsAmong(const MappingState& state,
                                   const std::vector<ImageSlot>& images) {
  const CorrespondenceGraph& graph = state.Graph();
  std::vector<StepSample> samples;
  for (const ImageSlot a : images) {
    for (const uint32_t p : graph.pairs_of_image[a]) {
      const ImageSlot b = graph.pairs[p].b;
      if (a == b || std::ranges::count(images, b) == 0) continue;
      const StepSample sample = SampleOf(state, a, b);
      if (std::isfinite(sample.sigma_m) && sample.length > 0.0) samples.push_back(sample);
    }
  }
  return samples;
}

/// Where half of the steps agree best: the others may be wrong all in one way.
double MetresPerUnit(const std::vector<StepSample>& samples) {
  std::vector<double> logs;
  for (const StepSample& sample : samples)
    logs.push_back(std::log(sample.length_m / sample.length));
  const Interval half = ShortestHalf(logs);
  return std::exp(0.5 * (half.low + half.high));
}

/// How many times their stated sigmas steps within drives are off, or those between two of them, by
/// the best of them.
double FactorOf(const std::vector<StepSample>& samples,
                bool is_within_drive,
                double metres_per_unit) {
  std::vector<double> errors;
  for (const StepSample& sample : samples) {
    if (sample.is_within_drive != is_within_drive) continue;
    errors.push_back(std::abs(metres_per_unit * sample.length - sample.length_m) / sample.sigma_m);
  }
  return FactorOfErrors(std::move(errors));
}

}  // namespace

StepWitness::StepWitness(const MappingState& state, ImageSlot image) {
  if (!state.Problem().images[image].prior.position_in_enu) return;
  const std::vector<ImageSlot> around = ImagesAround(state, image);
  const std::vector<StepSample> samples = StepsAmong(state, around);
  if (samples.empty()) return;
  metres_per_unit_ = MetresPerUnit(samples);
  const double factor_within = FactorOf(samples, true, metres_per_unit_);
  const double factor_between = FactorOf(samples, false, metres_per_unit_);
  for (const ImageSlot other : around) {
    const GnssStep step = StepBetween(state.Problem(), image, other);
    if (!std::isfinite(step.sigma)) continue;
    const double length_m = std::exp(step.log_length);
    const double factor = AreOfOneDrive(state, image, other) ? factor_within : factor_between;
    steps_.push_back({.image = other,
                      .from = state.Centre(other),
                      .length_m = length_m,
                      .sigma_m = length_m * std::hypot(factor * step.sigma, kUnitShare)});
  }
  std::ranges::stable_sort(steps_, {}, &Step::length_m);
  steps_.resize(std::min(steps_.size(), kMaxSteps));
}

bool StepWitness::Contradicts(const Eigen::Vector3d& centre) const {
  constexpr double kMaxSigmas = 2.0;  // it is asked where points are not at one
  return Misfit(centre).value_or(0.0) > kMaxSigmas;
}

bool StepWitness::Supports(const Eigen::Vector3d& centre) const {
  constexpr double kMaxSigmas = 1.0;
  const std::optional<double> misfit = Misfit(centre);
  return misfit && *misfit <= kMaxSigmas;
}

std::vector<ImageSlot> StepWitness::Witnesses() const {
  std::vector<ImageSlot> images;
  for (const Step& step : steps_) images.push_back(step.image);
  return images;
}

std::optional<double> StepWitness::Misfit(const Eigen::Vector3d& centre) const {
  if (steps_.size() < kFewestSteps) return std::nullopt;
  std::vector<double> misfits;
  for (const Step& step : steps_) {
    const double length_m = metres_per_unit_ * (centre - step.from).norm();
    misfits.push_back(std::abs(length_m - step.length_m) / step.sigma_m);
  }
  return UpperMedian(misfits);
}

}  // namespace orbweave
