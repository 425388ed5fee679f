// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/pair_kernels.h"

#include <algorithm>
#include <cmath>

#include "core/base/for_each_processor.h"

namespace orbweave::internal {
namespace {

constexpr size_t kLanes = 8;
constexpr double kEpipole = 1e-12;  // squared sine to the baseline; closer bearings have no plane

using Lanes = std::array<double, kLanes>;

double Sum(const Lanes& lanes) {
  double sum = 0.0;
  for (const double lane : lanes) sum += lane;
  return sum;
}

/// Eight pairs with a column per coordinate; lanes beyond the last pair are zero.
struct PairLanes {
  std::array<Lanes, 3> a{};
  std::array<Lanes, 3> b{};

  [[gnu::always_inline]] void Take(const double* from_a, const double* from_b, size_t count) {
    for (size_t l = 0; l < count; ++l) {
      for (size_t k = 0; k < 3; ++k) {
        a[k][l] = from_a[3 * l + k];
        b[k][l] = from_b[3 * l + k];
      }
    }
    for (size_t l = count; l < kLanes; ++l) {
      for (size_t k = 0; k < 3; ++k) a[k][l] = b[k][l] = 0.0;
    }
  }
};

/// Residual, Jacobian and weight of eight pairs.
struct ResidualLanes {
  Lanes r;
  Lanes weight;
  std::array<Lanes, kPoseParameters> J;
};

/// r = f / s, f = T.(q x p), s^2 = 1 - ((T.q)^2 + (T.p)^2) / 2; dq = theta x q, dT = B tau;
/// dr = df / s - f / (2 s^3) d(s^2). Pairs without a plane, or without bearings, weigh nothing.
[[gnu::always_inline]] inline void Linearise(const PoseTerms& pose,
                                             const PairLanes& pairs,
                                             double squared_scale,
                                             ResidualLanes& out) {
  const auto& R = pose.R;
  const double tx = pose.T[0];
  const double ty = pose.T[1];
  const double tz = pose.T[2];
  for (size_t l = 0; l < kLanes; ++l) {
    const double ax = pairs.a[0][l];
    const double ay = pairs.a[1][l];
    const double az = pairs.a[2][l];
    const double px = pairs.b[0][l];
    const double py = pairs.b[1][l];
    const double pz = pairs.b[2][l];
    const double qx = R[0] * ax + R[1] * ay + R[2] * az;
    const double qy = R[3] * ax + R[4] * ay + R[5] * az;
    const double qz = R[6] * ax + R[7] * ay + R[8] * az;
    const double along_a = tx * qx + ty * qy + tz * qz;
    const double along_b = tx * px + ty * py + tz * pz;
    const double s2 = 1.0 - 0.5 * (along_a * along_a + along_b * along_b);
    const bool has_plane = s2 > kEpipole;
    const double safe_s2 = has_plane ? s2 : 1.0;
    const double inverse_s = 1.0 / std::sqrt(safe_s2);
    // normal = q x p, and p x T, q x T, q x (p x T)
    const double nx = qy * pz - qz * py;
    const double ny = qz * px - qx * pz;
    const double nz = qx * py - qy * px;
    const double cx = py * tz - pz * ty;
    const double cy = pz * tx - px * tz;
    const double cz = px * ty - py * tx;
    const double r = (tx * nx + ty * ny + tz * nz) * inverse_s;
    const double k = r / (2.0 * safe_s2);
    const double ka = k * along_a;
    const double kb = k * along_b;
    out.J[0][l] = (qy * cz - qz * cy) * inverse_s + ka * (qy * tz - qz * ty);
    out.J[1][l] = (qz * cx - qx * cz) * inverse_s + ka * (qz * tx - qx * tz);
    out.J[2][l] = (qx * cy - qy * cx) * inverse_s + ka * (qx * ty - qy * tx);
    const double vx = nx * inverse_s + ka * qx + kb * px;
    const double vy = ny * inverse_s + ka * qy + kb * py;
    const double vz = nz * inverse_s + ka * qz + kb * pz;
    out.J[3][l] = pose.B[0] * vx + pose.B[1] * vy + pose.B[2] * vz;
    out.J[4][l] = pose.B[3] * vx + pose.B[4] * vy + pose.B[5] * vz;
    out.r[l] = has_plane ? r : 0.0;
    out.weight[l] = has_plane ? squared_scale / (squared_scale + r * r) : 0.0;
  }
}

/// The logarithm of the product of 1 + x, as exact for small x as log1p.
double LogOfProduct(const Lanes& r, double squared_scale) {
  double product = 0.0;  // minus 1
  for (const double each : r) {
    const double x = each * each / squared_scale;
    product += x + product * x;
  }
  return std::log1p(product);
}

ORBWEAVE_FOR_EACH_PROCESSOR
void AddResiduals(const PoseTerms& pose,
                  const PairLanes& pairs,
                  double squared_scale,
                  ResidualLanes& each,
                  std::array<Lanes, kPoseTriangle>& H,
                  std::array<Lanes, kPoseParameters>& g) {
  Linearise(pose, pairs, squared_scale, each);
  size_t entry = 0;
  for (size_t i = 0; i < kPoseParameters; ++i) {
    Lanes weighted;
    for (size_t l = 0; l < kLanes; ++l) weighted[l] = each.weight[l] * each.J[i][l];
    for (size_t l = 0; l < kLanes; ++l) g[i][l] += weighted[l] * each.r[l];
    for (size_t j = 0; j <= i; ++j, ++entry) {
      for (size_t l = 0; l < kLanes; ++l) H[entry][l] += weighted[l] * each.J[j][l];
    }
  }
}

}  // namespace

ORBWEAVE_FOR_EACH_PROCESSOR
void SquaredSines(const EpipolarTerms& terms,
                  const PairColumns& pairs,
                  size_t count,
                  double* __restrict squared) {
  const EpipolarTerms t = terms;
  const auto [ax, ay, az] = pairs.a;
  const auto [bx, by, bz] = pairs.b;
  for (size_t i = 0; i < count; ++i) {
    const double f = bx[i] * (t.E[0] * ax[i] + t.E[1] * ay[i] + t.E[2] * az[i]) +
                     by[i] * (t.E[3] * ax[i] + t.E[4] * ay[i] + t.E[5] * az[i]) +
                     bz[i] * (t.E[6] * ax[i] + t.E[7] * ay[i] + t.E[8] * az[i]);
    const double along_a = t.T_in_a[0] * ax[i] + t.T_in_a[1] * ay[i] + t.T_in_a[2] * az[i];
    const double along_b = t.T[0] * bx[i] + t.T[1] * by[i] + t.T[2] * bz[i];
    squared[i] = f * f / (1.0 - 0.5 * (along_a * along_a + along_b * along_b));
  }
}

ORBWEAVE_FOR_EACH_PROCESSOR
void SquaredChords(const std::array<double, 9>& M,
                   const PairColumns& pairs,
                   size_t count,
                   double* __restrict squared) {
  const std::array<double, 9> m = M;
  const auto [ax, ay, az] = pairs.a;
  const auto [bx, by, bz] = pairs.b;
  for (size_t i = 0; i < count; ++i) {
    const double x = m[0] * ax[i] + m[1] * ay[i] + m[2] * az[i];
    const double y = m[3] * ax[i] + m[4] * ay[i] + m[5] * az[i];
    const double z = m[6] * ax[i] + m[7] * ay[i] + m[8] * az[i];
    const double inverse = 1.0 / std::sqrt(x * x + y * y + z * z);
    const double dx = x * inverse - bx[i];
    const double dy = y * inverse - by[i];
    const double dz = z * inverse - bz[i];
    squared[i] = dx * dx + dy * dy + dz * dz;
  }
}

ORBWEAVE_FOR_EACH_PROCESSOR
TruncatedSum SumTruncated(const double* values, size_t count, double limit) {
  Lanes cost{};
  std::array<int64_t, kLanes> below{};
  size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (size_t l = 0; l < kLanes; ++l) {
      const bool is_below = values[i + l] < limit;
      cost[l] += is_below ? values[i + l] : limit;
      below[l] += is_below ? 1 : 0;
    }
  }
  for (size_t l = 0; i < count; ++i, ++l) {
    const bool is_below = values[i] < limit;
    cost[l] += is_below ? values[i] : limit;
    below[l] += is_below ? 1 : 0;
  }
  TruncatedSum sum{.cost = Sum(cost)};
  for (const int64_t lane : below) sum.num_below += static_cast<uint32_t>(lane);
  return sum;
}

ORBWEAVE_FOR_EACH_PROCESSOR
ErrorCounts CountWithinPlanes(const TurnedColumns& a,
                              const TargetColumns& b,
                              size_t count,
                              const ErrorLimits& limits) {
  const auto [qx, qy, qz] = a.q;
  const auto [mx, my, mz] = a.m;
  const auto [bx, by, bz] = b.b;
  const double* const along_q = a.along_q;
  const double* const along_b = b.along_b;
  const auto [e0, e1, e2, e3] = limits.squared;
  const double min_cos_far = limits.min_cos_far;
  uint64_t n0 = 0;
  uint64_t n1 = 0;
  uint64_t n2 = 0;
  uint64_t n3 = 0;
  for (size_t i = 0; i < count; ++i) {
    const double f = bx[i] * mx[i] + by[i] * my[i] + bz[i] * mz[i];
    const double f2 = f * f;
    const double s2 = 1.0 - 0.5 * (along_q[i] * along_q[i] + along_b[i] * along_b[i]);
    const double cosine = qx[i] * bx[i] + qy[i] * by[i] + qz[i] * bz[i];
    const int is_far = cosine > min_cos_far ? 1 : 0;
    const int of_b = cosine * along_b[i] - along_q[i] > 0.0 ? 1 : 0;
    const int of_a = along_b[i] - cosine * along_q[i] > 0.0 ? 1 : 0;
    const int counts = is_far | (of_a & of_b);
    n0 += static_cast<uint64_t>(counts & (f2 < e0 * s2 ? 1 : 0));
    n1 += static_cast<uint64_t>(counts & (f2 < e1 * s2 ? 1 : 0));
    n2 += static_cast<uint64_t>(counts & (f2 < e2 * s2 ? 1 : 0));
    n3 += static_cast<uint64_t>(counts & (f2 < e3 * s2 ? 1 : 0));
  }
  return {n0, n1, n2, n3};
}

ORBWEAVE_FOR_EACH_PROCESSOR
ErrorCounts CountWithinAngles(const TurnedColumns& a,
                              const TargetColumns& b,
                              size_t count,
                              const ErrorLimits& limits) {
  const auto [qx, qy, qz] = a.q;
  const auto [bx, by, bz] = b.b;
  const auto [e0, e1, e2, e3] = limits.squared;
  uint64_t n0 = 0;
  uint64_t n1 = 0;
  uint64_t n2 = 0;
  uint64_t n3 = 0;
  for (size_t i = 0; i < count; ++i) {
    const double dx = qx[i] - bx[i];
    const double dy = qy[i] - by[i];
    const double dz = qz[i] - bz[i];
    const double squared = dx * dx + dy * dy + dz * dz;
    n0 += squared < e0 ? 1U : 0U;
    n1 += squared < e1 ? 1U : 0U;
    n2 += squared < e2 ? 1U : 0U;
    n3 += squared < e3 ? 1U : 0U;
  }
  return {n0, n1, n2, n3};
}

ResidualSums SumEpipolarResiduals(const PoseTerms& pose,
                                  const double* bearings_a,
                                  const double* bearings_b,
                                  size_t count,
                                  double loss_scale) {
  const double squared_scale = loss_scale * loss_scale;
  std::array<Lanes, kPoseTriangle> H{};
  std::array<Lanes, kPoseParameters> g{};
  PairLanes pairs;
  ResidualLanes each;
  ResidualSums sums;
  for (size_t i = 0; i < count; i += kLanes) {
    pairs.Take(bearings_a + 3 * i, bearings_b + 3 * i, std::min(kLanes, count - i));
    AddResiduals(pose, pairs, squared_scale, each, H, g);
    sums.cost += LogOfProduct(each.r, squared_scale);
  }
  sums.cost *= squared_scale;
  for (size_t k = 0; k < H.size(); ++k) sums.H[k] = Sum(H[k]);
  for (size_t k = 0; k < g.size(); ++k) sums.g[k] = Sum(g[k]);
  return sums;
}

}  // namespace orbweave::internal
