// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/centre_by_lengths.h"

#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/mapping/lengths/log_length_of_pair.h"
#include "core/mapping/lengths/ray_depths.h"
#include "core/mapping/lengths/told_lengths.h"

namespace orbweave {
namespace {

constexpr double kClearlyMore = 1.2;
constexpr size_t kFewestPairs = 3;

/// How a pair leads to the image from one that is registered.
struct ToldStep {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  ToldLengths lengths;
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
    if (const std::optional<double> told = LengthsOnRay(ray, known).ToldByOthers(first))
      lengths.push_back(*told);
  });
  return lengths;
}

std::vector<ToldStep> StepsTo(const MappingState& state, ImageSlot image, double min_angle_rad) {
  std::vector<ToldStep> steps;
  for (const uint32_t p : state.Graph().pairs_of_image[image]) {
    const LinkedPair& pair = state.Graph().pairs[p];
    const Approach approach{p, pair.Other(image)};
    if (!HasRotationOfModel(state, pair)) continue;
    std::vector<double> log_lengths = LengthsOf(state, image, approach, min_angle_rad);
    if (log_lengths.size() < kFewestRaysOfPair) continue;
    steps.push_back({state.Centre(approach.from),
                     ToldLengths(DirectionOf(state, approach), std::move(log_lengths))});
  }
  return steps;
}

double CountAgreeing(const std::vector<ToldStep>& steps, const Eigen::Vector3d& centre) {
  double count = 0.0;
  for (const ToldStep& step : steps) count += step.lengths.CountAgreeing(centre - step.from);
  return count;
}

/// Where each pair leads.
std::vector<Eigen::Vector3d> CandidatesOf(const std::vector<ToldStep>& steps) {
  std::vector<Eigen::Vector3d> candidates;
  for (const ToldStep& step : steps) {
    for (const double length : step.lengths.Modes())
      candidates.emplace_back(step.from + length * step.lengths.Direction());
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
