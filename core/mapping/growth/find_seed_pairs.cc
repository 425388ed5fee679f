// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/growth/find_seed_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/mapping/model/mapping_schedule.h"

namespace orbweave {
namespace {

constexpr int kPlanarLevels = 4;
constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

/// Halvings of `wanted` until `value` suffices; `strictly`: is more.
int Halvings(double wanted, double value, bool strictly) {
  int halvings = 0;
  for (; value < wanted || (strictly && value == wanted); wanted /= 2.0) ++halvings;
  return halvings;
}

/// Matches whose rays meet under at least min_angle_rad: those that will make points. The angle at
/// the point is the angle between the two rays.
uint32_t CountDeepMatches(const ClusterProblem& problem,
                          const CorrespondenceGraph& graph,
                          const LinkedPair& pair,
                          double min_angle_rad) {
  const TwoViewGeometry& geometry = problem.pairs[pair.index];
  const Eigen::Matrix3d R = geometry.b_from_a.rotation.toRotationMatrix();
  const double max_abs_cos = std::cos(min_angle_rad);
  uint32_t count = 0;
  for (const FeatureMatch& match : geometry.inliers) {
    const Eigen::Vector3d& a = graph.bearing_of_node[graph.node_of_feature[pair.a][match.a]];
    const Eigen::Vector3d& b = graph.bearing_of_node[graph.node_of_feature[pair.b][match.b]];
    if (std::abs(b.dot(R * a)) <= max_abs_cos) ++count;
  }
  return count;
}

struct Candidate {
  uint32_t pair = 0;
  int level = 0;
  uint64_t image_matches = 0;  ///< of its better connected image; 0 where that does not rank
  ImageSlot first_image = 0;   ///< that image; 0 where that does not rank
  uint32_t matches = 0;        ///< that rank: those that show depth, or all
};

bool IsBetter(const Candidate& x, const Candidate& y) {
  return std::tuple(x.level, y.image_matches, x.first_image, y.matches, x.pair) <
         std::tuple(y.level, x.image_matches, y.first_image, x.matches, y.pair);
}

std::vector<uint64_t> MatchesPerImage(const ClusterProblem& problem,
                                      const CorrespondenceGraph& graph) {
  std::vector<uint64_t> matches(graph.NumImages(), 0);
  for (const LinkedPair& pair : graph.pairs) {
    matches[pair.a] += problem.pairs[pair.index].inliers.size();
    matches[pair.b] += problem.pairs[pair.index].inliers.size();
  }
  return matches;
}

}  // namespace

std::vector<uint32_t> FindSeedPairs(const ClusterProblem& problem,
                                    const CorrespondenceGraph& graph,
                                    std::span<const uint8_t> available,
                                    const MappingOptions& options) {
  const std::vector<uint64_t> image_matches = MatchesPerImage(problem, graph);
  const bool by_image = ScheduleOf(options).seeds_by_image;
  std::vector<Candidate> candidates;
  for (uint32_t p = 0; p < graph.pairs.size(); ++p) {
    const LinkedPair& pair = graph.pairs[p];
    const TwoViewGeometry& geometry = problem.pairs[pair.index];
    if (available[pair.a] == 0 || available[pair.b] == 0 ||
        geometry.kind == TwoViewKind::kPureRotation || !(geometry.median_angle_rad > 0.0)) {
      continue;
    }
    const uint32_t deep_matches =
        CountDeepMatches(problem, graph, pair, options.min_angle_deg * kRadiansPerDegree);
    if (deep_matches < static_cast<uint32_t>(options.min_inliers)) continue;
    const auto num_matches = static_cast<uint32_t>(geometry.inliers.size());
    const int level =
        Halvings(options.seed_min_inliers, num_matches, by_image) +
        Halvings(
            options.seed_min_angle_deg, geometry.median_angle_rad / kRadiansPerDegree, by_image) +
        (geometry.kind == TwoViewKind::kPlanar && !by_image ? kPlanarLevels : 0);
    if (by_image) {
      const bool a_is_first = image_matches[pair.a] >= image_matches[pair.b];
      const ImageSlot first = a_is_first ? pair.a : pair.b;
      candidates.push_back({p, level, image_matches[first], first, num_matches});
    } else {
      candidates.push_back({p, level, 0, 0, deep_matches});
    }
  }
  std::sort(candidates.begin(), candidates.end(), IsBetter);
  std::vector<uint32_t> pairs;
  pairs.reserve(candidates.size());
  for (const Candidate& candidate : candidates) pairs.push_back(candidate.pair);
  return pairs;
}

}  // namespace orbweave
