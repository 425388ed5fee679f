// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/centre_by_lengths.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/mapping/log_length_of_pair.h"
#include "core/mapping/ray_depths.h"

namespace orbweave {
namespace {

constexpr double kClearlyMore = 1.2;
/// A pair that tracks fooled has many rays; what counts is how many pairs say the same.
constexpr double kMaxRays = 50.0;
constexpr size_t kFewestPairs = 3;
constexpr size_t kModes = 2;

/// How a pair leads to the image from one that is registered.
struct ToldStep {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit, in the world
  std::vector<double> log_lengths{};                    ///< a ray each, ascending

  [[nodiscard]] Eigen::Vector3d To(double log_length) const {
    return from + std::exp(log_length) * direction;
  }
  /// Rays that agree with a centre, of kMaxRays at most.
  [[nodiscard]] double CountAgreeing(const Eigen::Vector3d& centre) const {
    const Eigen::Vector3d step = centre - from;
    const double length = step.norm();
    if (!(length > 0.0) || step.dot(direction) < kMinCosDirection * length) return 0.0;
    const auto count = static_cast<double>(
        std::ranges::upper_bound(log_lengths, std::log(length) + kLengthTolerance) -
        std::ranges::lower_bound(log_lengths, std::log(length) - kLengthTolerance));
    return count * std::min(1.0, kMaxRays / static_cast<double>(log_lengths.size()));
  }
  /// The middle of the interval of agreeing lengths that holds most of them.
  [[nodiscard]] double Mode() const {
    double mode = 0.0;
    ptrdiff_t most = 0;
    for (auto first = log_lengths.begin(); first != log_lengths.end(); ++first) {
      const auto last = std::upper_bound(first, log_lengths.end(), *first + 2.0 * kLengthTolerance);
      if (last - first <= most) continue;
      most = last - first;
      mode = 0.5 * (*first + *(last - 1));
    }
    return mode;
  }
};

/// A pair of the image, seen from the other.
struct Approach {
  uint32_t pair = 0;  ///< of the graph's
  ImageSlot from = 0;
};

Eigen::Vector3d DirectionOf(const MappingState& state, const Approach& approach) {
  const LinkedPair& pair = state.Graph().pairs[approach.pair];
  const Rigid3& b_from_a = state.Problem().pairs[pair.index].b_from_a;
  const Eigen::Vector3d in_from =
      approach.from == pair.a ? b_from_a.Centre() : Eigen::Vector3d(b_from_a.translation);
  return state.CamFromWorld(approach.from).rotation.conjugate() * in_from.normalized();
}

/// Lengths by the rays of approach.from.
std::vector<double> LengthsOf(const MappingState& state,
                              ImageSlot image,
                              const Approach& approach,
                              double min_angle_rad) {
  const CorrespondenceGraph& graph = state.Graph();
  std::vector<uint32_t> pairs = {approach.pair};
  std::vector<double> known = {0.0};
  for (const uint32_t q : graph.pairs_of_image[approach.from]) {
    if (graph.pairs[q].a == image || graph.pairs[q].b == image) continue;
    const std::optional<double> log_length = LogLengthOfPair(state, graph.pairs[q]);
    if (!log_length) continue;
    pairs.push_back(q);
    known.push_back(*log_length);
  }
  const std::vector<RayDepth> depths =
      MeasureRayDepths(state.Problem(), graph, pairs, min_angle_rad);
  std::vector<double> lengths;
  ForEachRay(depths, [&](std::span<const RayDepth> ray) {
    const RayDepth& first = ray.front();
    if (graph.image_of_node[first.node] != approach.from || first.pair != 0) return;
    if (const std::optional<double> told = ToldLogLength(ray, first, known))
      lengths.push_back(*told);
  });
  std::ranges::sort(lengths);
  return lengths;
}

std::vector<ToldStep> StepsTo(const MappingState& state, ImageSlot image, double min_angle_rad) {
  std::vector<ToldStep> steps;
  for (const uint32_t p : state.Graph().pairs_of_image[image]) {
    const LinkedPair& pair = state.Graph().pairs[p];
    const Approach approach{p, pair.a == image ? pair.b : pair.a};
    if (!HasRotationOfModel(state, pair)) continue;
    ToldStep step{.from = state.Centre(approach.from),
                  .direction = DirectionOf(state, approach),
                  .log_lengths = LengthsOf(state, image, approach, min_angle_rad)};
    if (step.log_lengths.size() >= kFewestRaysOfPair) steps.push_back(std::move(step));
  }
  return steps;
}

double CountAgreeing(const std::vector<ToldStep>& steps, const Eigen::Vector3d& centre) {
  double count = 0.0;
  for (const ToldStep& step : steps) count += step.CountAgreeing(centre);
  return count;
}

/// Where each pair leads.
std::vector<Eigen::Vector3d> CandidatesOf(const std::vector<ToldStep>& steps) {
  std::vector<Eigen::Vector3d> candidates;
  for (ToldStep step : steps) {
    for (size_t i = 0; i < kModes && !step.log_lengths.empty(); ++i) {
      const double mode = step.Mode();
      candidates.push_back(step.To(mode));
      std::erase_if(step.log_lengths, [mode](double log_length) {
        return std::abs(log_length - mode) <= kLengthTolerance;
      });
    }
  }
  return candidates;
}

}  // namespace

std::optional<Eigen::Vector3d> CentreByLengths(const MappingState& state,
                                               ImageSlot image,
                                               const MappingOptions& options) {
  const double min_angle_rad = options.min_angle_deg / 180.0 * std::numbers::pi;
  const std::vector<ToldStep> steps = StepsTo(state, image, min_angle_rad);
  if (steps.size() < kFewestPairs) return std::nullopt;
  double most = kClearlyMore * CountAgreeing(steps, state.Centre(image));
  std::optional<Eigen::Vector3d> best;
  for (const Eigen::Vector3d& candidate : CandidatesOf(steps)) {
    const double count = CountAgreeing(steps, candidate);
    if (count <= most) continue;
    most = count;
    best = candidate;
  }
  return best;
}

}  // namespace orbweave
