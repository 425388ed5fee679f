// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/average_baselines.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/averaging/average_differences.h"
#include "core/base/quantile.h"
#include "core/graph/disjoint_sets.h"

namespace orbweave {
namespace {

/// Fewer shared rays say nothing of two baselines.
constexpr size_t kMinShared = 8;
/// In one image a pair is compared with those few others that tell most, which keeps the system
/// sparse where streets cross.
constexpr int kMaxPartners = 4;
/// Towards the baseline itself depths are as good as unknown.
constexpr double kMinSine = 0.05;

/// The depth of a ray as one pair has it.
struct DepthSample {
  Node node = 0;
  uint32_t pair = 0;  ///< position among the given pairs
  double log_depth = 0.0;
};

/// Log depths of the rays of all matches, sorted by (node, pair).
std::vector<DepthSample> SampleDepths(const ClusterProblem& problem,
                                      const CorrespondenceGraph& graph,
                                      std::span<const uint32_t> pairs,
                                      double min_angle_rad) {
  const double min_sin_angle = std::sin(min_angle_rad);
  std::vector<DepthSample> samples;
  for (uint32_t i = 0; i < pairs.size(); ++i) {
    const LinkedPair& pair = graph.pairs[pairs[i]];
    const TwoViewGeometry& geometry = problem.pairs[pair.index];
    const Eigen::Matrix3d a_from_b = geometry.b_from_a.rotation.conjugate().toRotationMatrix();
    const Eigen::Vector3d baseline = geometry.b_from_a.Centre();
    for (const FeatureMatch& match : geometry.inliers) {
      const Node a = graph.node_of_feature[pair.a][match.a];
      const Node b = graph.node_of_feature[pair.b][match.b];
      const Eigen::Vector3d ray_a = graph.bearing_of_node[a];
      const Eigen::Vector3d ray_b = a_from_b * graph.bearing_of_node[b];
      const double sin_x = ray_a.cross(ray_b).norm();
      const double sin_a = baseline.cross(ray_a).norm();
      const double sin_b = baseline.cross(ray_b).norm();
      if (sin_x < min_sin_angle || sin_a < kMinSine || sin_b < kMinSine) continue;
      samples.push_back({a, i, std::log(sin_b / sin_x)});
      samples.push_back({b, i, std::log(sin_a / sin_x)});
    }
  }
  std::sort(samples.begin(), samples.end(), [](const DepthSample& x, const DepthSample& y) {
    return std::tuple(x.node, x.pair, x.log_depth) < std::tuple(y.node, y.pair, y.log_depth);
  });
  return samples;
}

/// What two pairs say of the ratio of their baselines in one image: a sample per shared ray.
class RatioTable {
 public:
  explicit RatioTable(uint32_t num_pairs) : local_of_pair_(num_pairs, 0) {}

  /// `samples`: those of one image.
  void Fill(std::span<const DepthSample> samples) {
    pairs_.clear();
    for (const DepthSample& sample : samples) pairs_.push_back(sample.pair);
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    for (uint32_t i = 0; i < pairs_.size(); ++i) local_of_pair_[pairs_[i]] = i;
    if (cells_.size() < pairs_.size() * pairs_.size()) cells_.resize(pairs_.size() * pairs_.size());
    for (auto& cell : cells_) cell.clear();
    for (size_t from = 0, to = 0; from < samples.size(); from = to) {
      for (to = from; to < samples.size() && samples[to].node == samples[from].node;) ++to;
      FillFromRay(samples.subspan(from, to - from));
    }
  }

  /// Appends edges between pairs with enough shared rays: those that share most first, as long as
  /// one of the two has few edges yet.
  void AppendEdges(DifferenceGraph& graph,
                   std::vector<double>& ratios,
                   std::vector<double>& counts) {
    std::vector<int> edges_of(pairs_.size(), 0);
    for (const auto& [i, j] : RankedCells()) {
      if (std::min(edges_of[i], edges_of[j]) >= kMaxPartners) continue;
      ++edges_of[i];
      ++edges_of[j];
      const std::vector<double>& cell = cells_[i * pairs_.size() + j];
      graph.edges.push_back({pairs_[i], pairs_[j]});
      ratios.push_back(UpperMedian(cell));
      counts.push_back(static_cast<double>(cell.size()));
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

  void FillFromRay(std::span<const DepthSample> samples) {
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

DifferenceGraph CompareBaselines(const CorrespondenceGraph& graph,
                                 const std::vector<DepthSample>& samples,
                                 uint32_t num_pairs) {
  DifferenceGraph ratios_graph{.num_nodes = num_pairs};
  std::vector<double> ratios;
  std::vector<double> counts;
  RatioTable table(num_pairs);
  for (size_t from = 0, to = 0; from < samples.size(); from = to) {
    const Node end = graph.first_node[graph.image_of_node[samples[from].node] + 1];
    while (to < samples.size() && samples[to].node < end) ++to;
    table.Fill(std::span(samples).subspan(from, to - from));
    table.AppendEdges(ratios_graph, ratios, counts);
  }
  const auto count = static_cast<Eigen::Index>(ratios.size());
  ratios_graph.differences = Eigen::Map<const Eigen::VectorXd>(ratios.data(), count);
  ratios_graph.weights = Eigen::Map<const Eigen::VectorXd>(counts.data(), count);
  return ratios_graph;
}

}  // namespace

absl::StatusOr<std::vector<double>> AverageBaselines(const ClusterProblem& problem,
                                                     const CorrespondenceGraph& graph,
                                                     std::span<const uint32_t> pairs,
                                                     double min_angle_rad,
                                                     const StageContext& context) {
  const auto num_pairs = static_cast<uint32_t>(pairs.size());
  const DifferenceGraph ratios =
      CompareBaselines(graph, SampleDepths(problem, graph, pairs, min_angle_rad), num_pairs);
  ORBWEAVE_ASSIGN_OR_RETURN(const AveragedDifferences averaged,
                            AverageDifferences(ratios, context));

  DisjointSets sets(num_pairs);
  for (const GraphEdge& edge : ratios.edges) sets.Unite(edge.a, edge.b);
  uint32_t largest = 0;
  for (uint32_t i = 0; i < num_pairs; ++i) {
    if (sets.SizeOf(i) > sets.SizeOf(largest)) largest = i;
  }
  std::vector<double> lengths(num_pairs, 0.0);
  for (uint32_t i = 0; i < num_pairs; ++i) {
    if (sets.Find(i) == sets.Find(largest)) lengths[i] = std::exp(averaged.values(i, 0));
  }
  return lengths;
}

}  // namespace orbweave
