// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/measure_pair_lengths.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "core/mapping/log_length_of_pair.h"
#include "core/mapping/ray_depths.h"

namespace orbweave {
namespace {

/// Pairs that take part, as indices into the graph's, and their lengths.
struct AskedPairs {
  std::vector<uint32_t> pairs{};
  std::vector<double> log_lengths{};

  explicit AskedPairs(const MappingState& state) {
    for (uint32_t p = 0; p < state.Graph().pairs.size(); ++p) {
      const std::optional<double> log_length = LogLengthOfPair(state, state.Graph().pairs[p]);
      if (!log_length) continue;
      pairs.push_back(p);
      log_lengths.push_back(*log_length);
    }
  }
};

/// Rays of one image that tell how long one pair is.
struct RayCount {
  size_t told = 0;
  size_t agreeing = 0;
};

/// What the rays of each pair's two images say, [2 i] of a and [2 i + 1] of b.
class RayCounts {
 public:
  RayCounts(const MappingState& state, const AskedPairs& asked)
      : state_(state), asked_(asked), counts_(2 * asked.pairs.size()) {}

  /// `depths`: of one ray.
  void Add(std::span<const RayDepth> depths) {
    for (const RayDepth& depth : depths) {
      const std::optional<double> told = ToldLogLength(depths, depth, asked_.log_lengths);
      if (!told) continue;
      RayCount& count = counts_[SideOf(depth)];
      ++count.told;
      count.agreeing +=
          std::abs(*told - asked_.log_lengths[depth.pair]) <= kLengthTolerance ? 1 : 0;
    }
  }
  /// Of pair `i` of those asked, at most kMaxRaysOfPair.
  [[nodiscard]] LengthAgreement Of(size_t i) const {
    LengthAgreement sum;
    for (const RayCount& count : {counts_[2 * i], counts_[2 * i + 1]}) {
      if (count.told < kFewestRaysOfPair) continue;
      sum.told += static_cast<double>(count.told);
      sum.agreeing += static_cast<double>(count.agreeing);
    }
    const double weight = std::min(1.0, kMaxRaysOfPair / std::max(sum.told, 1.0));
    return {.told = weight * sum.told, .agreeing = weight * sum.agreeing};
  }

 private:
  [[nodiscard]] size_t SideOf(const RayDepth& depth) const {
    const LinkedPair& pair = state_.Graph().pairs[asked_.pairs[depth.pair]];
    return 2 * size_t{depth.pair} + (state_.Graph().image_of_node[depth.node] == pair.b ? 1 : 0);
  }

  const MappingState& state_;
  const AskedPairs& asked_;
  std::vector<RayCount> counts_;
};

/// The images of each drive, in order of their ids.
std::vector<std::vector<ImageId>> ImagesOfDrives(const ClusterProblem& problem) {
  std::map<uint32_t, std::vector<ImageId>> of_drive;
  for (const ClusterImage& image : problem.images) of_drive[image.drive].push_back(image.id);
  std::vector<std::vector<ImageId>> sequences;
  for (auto& [drive, images] : of_drive) sequences.push_back(std::move(images));
  return sequences;
}

}  // namespace

std::vector<PairLength> MeasurePairLengths(const MappingState& state,
                                           const MappingOptions& options) {
  const AskedPairs asked(state);
  const double min_angle_rad = options.min_angle_deg / 180.0 * std::numbers::pi;
  const std::vector<RayDepth> depths =
      MeasureRayDepths(state.Problem(), state.Graph(), asked.pairs, min_angle_rad);
  RayCounts counts(state, asked);
  ForEachRay(depths, [&](std::span<const RayDepth> ray) { counts.Add(ray); });
  std::vector<PairLength> lengths;
  for (size_t i = 0; i < asked.pairs.size(); ++i) {
    const LinkedPair& pair = state.Graph().pairs[asked.pairs[i]];
    lengths.push_back({state.Problem().pairs[pair.index].pair, counts.Of(i)});
  }
  return lengths;
}

std::vector<LengthFault> FindLengthFaults(const MappingState& state,
                                          const MappingOptions& options) {
  return FindLengthFaults(MeasurePairLengths(state, options), ImagesOfDrives(state.Problem()));
}

double CountAgreeingRays(const MappingState& state, const MappingOptions& options) {
  double count = 0.0;
  for (const PairLength& pair : MeasurePairLengths(state, options))
    count += pair.agreement.agreeing;
  return count;
}

}  // namespace orbweave
