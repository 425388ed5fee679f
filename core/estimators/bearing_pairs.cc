// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/bearing_pairs.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/essential.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// Squared sines for the pairs [begin, end): (p_b^T E p_a)^2 / (1 - ((T.R p_a)^2 + (T.p_b)^2) / 2).
/// NaN where both bearings are epipoles, which no threshold admits.
void SquaredSines(
    const BearingPairs& pairs, const Rigid3& b_from_a, size_t begin, size_t end, double* squared) {
  const Eigen::Matrix3d E = EssentialFromPose(b_from_a);
  const Vector3d T = b_from_a.translation;
  const Vector3d RtT = b_from_a.rotation.conjugate() * T;
  const double* const ax = pairs.a[0].data() + begin;
  const double* const ay = pairs.a[1].data() + begin;
  const double* const az = pairs.a[2].data() + begin;
  const double* const bx = pairs.b[0].data() + begin;
  const double* const by = pairs.b[1].data() + begin;
  const double* const bz = pairs.b[2].data() + begin;
  for (size_t i = 0; i < end - begin; ++i) {
    const double f = bx[i] * (E(0, 0) * ax[i] + E(0, 1) * ay[i] + E(0, 2) * az[i]) +
                     by[i] * (E(1, 0) * ax[i] + E(1, 1) * ay[i] + E(1, 2) * az[i]) +
                     bz[i] * (E(2, 0) * ax[i] + E(2, 1) * ay[i] + E(2, 2) * az[i]);
    const double along_a = RtT.x() * ax[i] + RtT.y() * ay[i] + RtT.z() * az[i];
    const double along_b = T.x() * bx[i] + T.y() * by[i] + T.z() * bz[i];
    squared[i] = f * f / (1.0 - 0.5 * (along_a * along_a + along_b * along_b));
  }
}

}  // namespace

BearingPairs ArrangePairs(std::span<const Vector3d> bearings_a,
                          std::span<const Vector3d> bearings_b,
                          std::span<const FeatureMatch> matches,
                          uint64_t seed) {
  BearingPairs pairs;
  pairs.order = ShuffledOrder(static_cast<uint32_t>(matches.size()), seed);
  for (int k = 0; k < 3; ++k) {
    pairs.a[k].reserve(matches.size());
    pairs.b[k].reserve(matches.size());
    for (const uint32_t i : pairs.order) {
      pairs.a[k].push_back(bearings_a[matches[i].a][k]);
      pairs.b[k].push_back(bearings_b[matches[i].b][k]);
    }
  }
  return pairs;
}

SelectedBearings SelectPairs(const BearingPairs& pairs, std::span<const uint32_t> indices) {
  SelectedBearings selected;
  selected.a.reserve(indices.size());
  selected.b.reserve(indices.size());
  for (const uint32_t i : indices) {
    selected.a.push_back(pairs.A(i));
    selected.b.push_back(pairs.B(i));
  }
  return selected;
}

std::optional<RansacScore> ScoreEpipolar(const BearingPairs& pairs,
                                         const Rigid3& b_from_a,
                                         double max_error_rad,
                                         const EarlyRejection& gate) {
  const double max_squared = std::sin(max_error_rad) * std::sin(max_error_rad);
  std::array<double, EarlyRejection::kBlock> squared;
  RansacScore score;
  for (size_t begin = 0; begin < pairs.Size(); begin += squared.size()) {
    const size_t end = std::min(begin + squared.size(), pairs.Size());
    SquaredSines(pairs, b_from_a, begin, end, squared.data());
    for (size_t i = 0; i < end - begin; ++i) {
      const bool inlier = squared[i] < max_squared;
      score.cost += inlier ? squared[i] : max_squared;
      score.num_inliers += inlier ? 1U : 0U;
    }
    if (gate.Rejects(score.cost, score.num_inliers, end)) return std::nullopt;
  }
  return score;
}

std::vector<uint32_t> EpipolarInliers(const BearingPairs& pairs,
                                      const Rigid3& b_from_a,
                                      double max_error_rad) {
  const double max_squared = std::sin(max_error_rad) * std::sin(max_error_rad);
  std::vector<double> squared(pairs.Size());
  SquaredSines(pairs, b_from_a, 0, pairs.Size(), squared.data());
  std::vector<uint32_t> inliers;
  for (uint32_t i = 0; i < squared.size(); ++i) {
    if (squared[i] < max_squared) inliers.push_back(i);
  }
  return inliers;
}

}  // namespace orbweave
