// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/average_baselines.h"

#include <algorithm>
#include <cmath>

#include "core/averaging/average_differences.h"
#include "core/base/shortest_half.h"
#include "core/graph/disjoint_sets.h"
#include "core/mapping/lengths/ray_depths.h"

namespace orbweave {
namespace {

/// Fewer shared rays say nothing of two baselines.
constexpr size_t kMinShared = 8;
/// In one image a pair is compared with those few others that tell most, which keeps the system
/// sparse where streets cross.
constexpr int kMaxPartners = 4;
/// Directions of baselines are no better than half a degree, nor are depths with them.
constexpr double kRatioFloor = 0.01;
/// A ratio is clear where its half lies within a fifth.
constexpr double kClearWidth = 0.2;
/// Steps of GNSS that say less than this say nothing: their lengths are those of the noise. None
/// counts as better than a tenth: a wrong position makes long steps, which seem the most exact.
constexpr double kMaxStepSigma = 0.5;
constexpr double kMinStepSigma = 0.1;

/// log s_b - log s_a of two pairs, by the rays that they share in one image.
struct Ratio {
  SeenRatio seen{};
  double sigma = 1.0;
  bool is_clear = false;
};

/// From where they lie closest, and those near.
Ratio RatioOf(uint32_t a, uint32_t b, const std::vector<double>& samples) {
  constexpr double kNear = 2.5;
  constexpr double kMedianOfNormal = 0.6745;
  const Interval half = ShortestHalf(samples);
  const double width = std::max(half.high - half.low, kRatioFloor);
  const double sigma = 0.5 * width / kMedianOfNormal;
  const double centre = 0.5 * (half.low + half.high);
  double sum = 0.0;
  double near = 0.0;
  for (const double sample : samples) {
    if (std::abs(sample - centre) > kNear * sigma) continue;
    sum += sample;
    near += 1.0;
  }
  return {.seen = {a, b, sum / near},
          .sigma = std::hypot(sigma / std::sqrt(near), kRatioFloor),
          .is_clear = width <= kClearWidth};
}

/// What two pairs say of the ratio of their baselines in one image: a sample per shared ray.
class RatioTable {
 public:
  explicit RatioTable(uint32_t num_pairs) : local_of_pair_(num_pairs, 0) {}

  /// `samples`: those of one image.
  void Fill(std::span<const RayDepth> samples) {
    pairs_.clear();
    for (const RayDepth& sample : samples) pairs_.push_back(sample.pair);
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    for (uint32_t i = 0; i < pairs_.size(); ++i) local_of_pair_[pairs_[i]] = i;
    if (cells_.size() < pairs_.size() * pairs_.size()) cells_.resize(pairs_.size() * pairs_.size());
    for (auto& cell : cells_) cell.clear();
    ForEachRay(samples, [&](std::span<const RayDepth> ray) { FillFromRay(ray); });
  }

  /// Appends ratios of pairs with enough shared rays: those that share most first, as long as one
  /// of the two has few yet.
  void Append(std::vector<Ratio>& ratios) {
    std::vector<int> edges_of(pairs_.size(), 0);
    for (const auto& [i, j] : RankedCells()) {
      if (std::min(edges_of[i], edges_of[j]) >= kMaxPartners) continue;
      ++edges_of[i];
      ++edges_of[j];
      const std::vector<double>& cell = cells_[i * pairs_.size() + j];
      ratios.push_back(RatioOf(pairs_[i], pairs_[j], cell));
    }
  }

 private:
  /// Rows and columns of the cells with enough samples, the fullest first.
  [[nodiscard]] std::vector<std::pair<uint32_t, uint32_t>> RankedCells() const {
    std::vector<std::pair<uint32_t, uint32_t>> ranked;
    const auto size = [&](const auto& cell) {
      return cells_[cell.first * pairs_.size() + cell.second].size();
    };
    for (uint32_t i = 0; i < pairs_.size(); ++i) {
      for (uint32_t j = i + 1; j < pairs_.size(); ++j) {
        if (size(std::pair(i, j)) >= kMinShared) ranked.emplace_back(i, j);
      }
    }
    std::stable_sort(ranked.begin(), ranked.end(), [&](const auto& x, const auto& y) {
      return size(x) > size(y);
    });
    return ranked;
  }

  void FillFromRay(std::span<const RayDepth> samples) {
    for (size_t p = 0; p < samples.size(); ++p) {
      for (size_t q = p + 1; q < samples.size(); ++q) {
        if (samples[p].pair == samples[q].pair) continue;
        const size_t row = local_of_pair_[samples[p].pair];
        const size_t column = local_of_pair_[samples[q].pair];
        cells_[row * pairs_.size() + column].push_back(samples[p].log_depth - samples[q].log_depth);
      }
    }
  }

  std::vector<uint32_t> pairs_{};          ///< of this image, ascending
  std::vector<uint32_t> local_of_pair_{};  ///< position in `pairs_`
  std::vector<std::vector<double>> cells_{};
};

std::vector<Ratio> CompareBaselines(const CorrespondenceGraph& graph,
                                    const std::vector<RayDepth>& samples,
                                    uint32_t num_pairs) {
  std::vector<Ratio> ratios;
  RatioTable table(num_pairs);
  for (size_t from = 0, to = 0; from < samples.size(); from = to) {
    const Node end = graph.first_node[graph.image_of_node[samples[from].node] + 1];
    while (to < samples.size() && samples[to].node < end) ++to;
    table.Fill(std::span(samples).subspan(from, to - from));
    table.Append(ratios);
  }
  return ratios;
}

double FactorOf(std::span<const GnssStep> steps, const std::vector<Ratio>& ratios) {
  std::vector<SeenRatio> clear;
  for (const Ratio& ratio : ratios) {
    if (ratio.is_clear) clear.push_back(ratio.seen);
  }
  return FactorOfSteps(steps, clear);
}

/// The logarithms of lengths as node values; the last node is the metre, where there are steps.
class LengthGraph {
 public:
  LengthGraph(uint32_t num_pairs, const std::vector<Ratio>& ratios, std::span<const GnssStep> steps)
      : metre_(num_pairs) {
    for (const Ratio& ratio : ratios)
      Add(ratio.seen.a, ratio.seen.b, ratio.seen.log_ratio, ratio.sigma);
    if (!steps.empty()) factor_ = FactorOf(steps, ratios);
    for (uint32_t i = 0; i < steps.size(); ++i) {
      const double sigma = factor_ * steps[i].sigma;
      if (sigma <= kMaxStepSigma)
        Add(metre_, i, steps[i].log_length, std::max(sigma, kMinStepSigma));
    }
  }

  absl::StatusOr<BaselineLengths> Solve(const StageContext& context) const {
    DifferenceGraph graph{.num_nodes = metre_ + 1, .edges = edges_};
    const auto count = static_cast<Eigen::Index>(edges_.size());
    graph.differences = Eigen::Map<const Eigen::VectorXd>(differences_.data(), count);
    graph.weights = Eigen::Map<const Eigen::VectorXd>(weights_.data(), count);
    ORBWEAVE_ASSIGN_OR_RETURN(const AveragedDifferences averaged,
                              AverageDifferences(graph, context));
    DisjointSets sets(metre_ + 1);
    for (const GraphEdge& edge : edges_) sets.Unite(edge.a, edge.b);
    const uint32_t largest = LargestSet(sets);
    BaselineLengths found{.lengths = std::vector<double>(metre_, 0.0),
                          .in_metres = sets.Find(metre_) == sets.Find(largest),
                          .step_factor = factor_};
    const double unit = found.in_metres ? averaged.values(metre_, 0) : 0.0;
    for (uint32_t i = 0; i < metre_; ++i) {
      if (sets.Find(i) == sets.Find(largest))
        found.lengths[i] = std::exp(averaged.values(i, 0) - unit);
    }
    return found;
  }

 private:
  void Add(uint32_t a, uint32_t b, double difference, double sigma) {
    edges_.push_back({a, b});
    differences_.push_back(difference);
    weights_.push_back(1.0 / (sigma * sigma));
  }

  /// A member of it.
  [[nodiscard]] uint32_t LargestSet(DisjointSets& sets) const {
    uint32_t largest = 0;
    for (uint32_t i = 0; i < metre_; ++i) {
      if (sets.SizeOf(i) > sets.SizeOf(largest)) largest = i;
    }
    return largest;
  }

  uint32_t metre_;
  double factor_ = 1.0;
  std::vector<GraphEdge> edges_{};
  std::vector<double> differences_{};
  std::vector<double> weights_{};
};

}  // namespace

absl::StatusOr<BaselineLengths> AverageBaselines(const ClusterProblem& problem,
                                                 const CorrespondenceGraph& graph,
                                                 std::span<const uint32_t> pairs,
                                                 std::span<const GnssStep> steps,
                                                 double min_angle_rad,
                                                 const StageContext& context) {
  const auto num_pairs = static_cast<uint32_t>(pairs.size());
  const std::vector<Ratio> ratios =
      CompareBaselines(graph, MeasureRayDepths(problem, graph, pairs, min_angle_rad), num_pairs);
  return LengthGraph(num_pairs, ratios, steps).Solve(context);
}

}  // namespace orbweave
