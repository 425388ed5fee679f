// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/bearing_pairs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geometry/essential.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// Squared sines for the pairs [begin, end).
void SquaredSines(
    const BearingPairs& pairs, const Rigid3& b_from_a, size_t begin, size_t end, double* squared) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> E = EssentialFromPose(b_from_a);
  const Vector3d T_in_a = b_from_a.rotation.conjugate() * b_from_a.translation;
  internal::EpipolarTerms terms;
  std::copy_n(E.data(), terms.E.size(), terms.E.begin());
  std::copy_n(b_from_a.translation.data(), terms.T.size(), terms.T.begin());
  std::copy_n(T_in_a.data(), terms.T_in_a.size(), terms.T_in_a.begin());
  internal::SquaredSines(terms, pairs.ColumnsFrom(begin), end - begin, squared);
}

}  // namespace

internal::PairColumns BearingPairs::ColumnsFrom(size_t first) const {
  internal::PairColumns columns;
  for (size_t k = 0; k < 3; ++k) {
    columns.a[k] = a[k].data() + first;
    columns.b[k] = b[k].data() + first;
  }
  return columns;
}

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

std::vector<uint32_t> AllOf(const BearingPairs& pairs) {
  std::vector<uint32_t> all(pairs.Size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
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
    const internal::TruncatedSum sum =
        internal::SumTruncated(squared.data(), end - begin, max_squared);
    score.cost += sum.cost;
    score.num_inliers += sum.num_below;
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
