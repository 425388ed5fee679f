// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// Loops over bearings of many pairs, compiled for several instruction sets with the same bits:
/// lanes are pairs, and sums run over lanes in one order. No Eigen: its types change with the
/// instruction set.

namespace orbweave::internal {

/// Bearings of both panoramas, a column per coordinate.
struct PairColumns {
  std::array<const double*, 3> a{};
  std::array<const double*, 3> b{};
};

/// What SymmetricEpipolarAngle needs of a pose: E = [T]x R by rows, T, and R^T T.
struct EpipolarTerms {
  std::array<double, 9> E{};
  std::array<double, 3> T{};
  std::array<double, 3> T_in_a{};
};

/// Squared sines of SymmetricEpipolarAngle, (p_b^T E p_a)^2 / (1 - ((T.R p_a)^2 + (T.p_b)^2) / 2).
/// NaN where both bearings are epipoles, which no threshold admits.
void SquaredSines(const EpipolarTerms& terms,
                  const PairColumns& pairs,
                  size_t count,
                  double* squared);

/// Squared chords between p_b and M p_a / |M p_a|; M by rows. NaN where M p_a is zero.
void SquaredChords(const std::array<double, 9>& M,
                   const PairColumns& pairs,
                   size_t count,
                   double* squared);

struct TruncatedSum {
  double cost = 0.0;       ///< sum of min(value, limit)
  uint32_t num_below = 0;  ///< values below the limit; NaN is none
};
[[nodiscard]] TruncatedSum SumTruncated(const double* values, size_t count, double limit);

/// Bearings of a already turned into b: q = R p_a and m = T x q, with T.q.
struct TurnedColumns {
  std::array<const double*, 3> q{};
  std::array<const double*, 3> m{};
  const double* along_q = nullptr;
};

/// Bearings of b, with T.p_b.
struct TargetColumns {
  std::array<const double*, 3> b{};
  const double* along_b = nullptr;
};

constexpr size_t kNumErrors = 4;
/// Pairs within each of some errors.
using ErrorCounts = std::array<uint64_t, kNumErrors>;

struct ErrorLimits {
  std::array<double, kNumErrors> squared{};  ///< sines, or chords where there is no baseline
  double min_cos_far = 1.0;                  ///< rays that meet at less have no reliable side
};

/// Pairs whose SymmetricEpipolarAngle is below each of the limits and that are far or in front of
/// both spheres (IsInFrontOfBoth).
[[nodiscard]] ErrorCounts CountWithinPlanes(const TurnedColumns& a,
                                            const TargetColumns& b,
                                            size_t count,
                                            const ErrorLimits& limits);

/// Pairs whose chord is below each of the limits.
[[nodiscard]] ErrorCounts CountWithinAngles(const TurnedColumns& a,
                                            const TargetColumns& b,
                                            size_t count,
                                            const ErrorLimits& limits);

/// A pose, and the plane B of steps of its direction, for SumEpipolarResiduals.
struct PoseTerms {
  std::array<double, 9> R{};  ///< by rows
  std::array<double, 3> T{};
  std::array<double, 6> B{};  ///< the two columns
};

constexpr size_t kPoseParameters = 5;
constexpr size_t kPoseTriangle = kPoseParameters * (kPoseParameters + 1) / 2;

struct ResidualSums {
  std::array<double, kPoseTriangle> H{};  ///< lower triangle by rows
  std::array<double, kPoseParameters> g{};
  double cost = 0.0;
};

/// LineariseEpipolarResiduals over bearings of x, y, z one after the other.
[[nodiscard]] ResidualSums SumEpipolarResiduals(const PoseTerms& pose,
                                                const double* bearings_a,
                                                const double* bearings_b,
                                                size_t count,
                                                double loss_scale);

}  // namespace orbweave::internal
