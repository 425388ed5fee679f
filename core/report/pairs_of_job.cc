// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/pairs_of_job.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "core/geometry/rotation.h"
#include "core/report/steps_apart.h"

namespace orbweave {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
// Pairs of neighbours are right to a degree or two in turn; in direction, where matches of a facade
// lead beside the way, to ten. Look-alikes and folds are off by twenty and more, as in
// PartsThatPairsHold.
constexpr double kExplained_rad = 10.0 * kDegree_rad;
constexpr double kContradicted_rad = 20.0 * kDegree_rad;
constexpr double kNear_steps = 0.5;

using Images = std::map<ImageId, RegisteredImage>;

/// By how much a model turns or leads otherwise than a pair of two of its images, whichever is
/// more.
double DifferenceOf(const CrossingPair& pair, const Images& images, double steps_apart) {
  const Rigid3 b_from_a =
      images.at(pair.pair.b).cam_from_world * images.at(pair.pair.a).cam_from_world.Inverse();
  const double turn_rad = RotationAngle(b_from_a.rotation * pair.b_from_a.rotation.conjugate());
  const Eigen::Vector3d b_in_a = b_from_a.Centre();
  if (steps_apart < kNear_steps || pair.b_from_a.translation.isZero()) return turn_rad;
  return std::max(turn_rad, AngleBetween(b_in_a, pair.b_from_a.Centre()));
}

void JudgeCrossingPairs(const std::vector<CrossingPair>& pairs,
                        const StepsApart& apart,
                        PairsOfJob& judged) {
  for (const CrossingPair& pair : pairs) {
    const std::optional<double> steps = apart.Between(pair.pair);
    if (!steps) continue;
    const double off_rad = DifferenceOf(pair, apart.ModelOf(pair.pair.a), *steps);
    if (off_rad < kExplained_rad) judged.explained.insert(pair.pair);
    if (off_rad > kContradicted_rad) judged.contradicted.insert(pair.pair);
  }
}

}  // namespace

PairsOfJob JudgePairsOfJob(const JobResults& results) {
  PairsOfJob judged;
  for (const ClusterSummary& cluster : results.clusters) {
    judged.explained.insert(cluster.explained_pairs.begin(), cluster.explained_pairs.end());
    judged.contradicted.insert(cluster.contradicted_pairs.begin(),
                               cluster.contradicted_pairs.end());
  }
  const StepsApart apart(results);
  JudgeCrossingPairs(results.view_graph.crossing, apart, judged);
  for (const ClusterSummary& cluster : results.clusters)
    JudgeCrossingPairs(cluster.parted_pairs, apart, judged);
  const auto is_unknown = [&](const ImagePair& pair) {
    return pair.b.value >= results.manifest.images.size();
  };
  std::erase_if(judged.contradicted, is_unknown);
  std::erase_if(judged.explained, [&](const ImagePair& pair) {
    return is_unknown(pair) || judged.contradicted.contains(pair);
  });
  return judged;
}

}  // namespace orbweave
