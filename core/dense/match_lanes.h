// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/dense/match_kernels.h"

/// The match kernel over vectors V of V::kWidth lanes; what it computes is said by
/// match_kernel_portable.cc, operation for operation. Whoever includes this file has defined
/// ORBWEAVE_LANES, the attributes of functions for the instructions that V uses.

namespace orbweave::internal {

template <typename V>
struct LaneVector {
  typename V::Floats x, y, z;
};

template <typename V>
struct LaneFace {
  typename V::Mask along_x, along_y;
  typename V::Floats sign;
  typename V::Ints index;
};

template <typename V>
struct LaneWarp {
  typename V::Ints u, v, u_by_column, v_by_column, u_by_row, v_by_row;
  typename V::Mask valid;
};

template <typename V>
ORBWEAVE_LANES LaneFace<V> FaceOfLanes(const LaneVector<V>& v) {
  const auto ax = V::Abs(v.x);
  const auto ay = V::Abs(v.y);
  const auto az = V::Abs(v.z);
  const auto along_y = V::And(V::Less(ax, ay), V::Less(az, ay));
  const auto along_x = V::AndNot(along_y, V::Less(az, ax));
  const auto main = V::Select(along_y, v.y, V::Select(along_x, v.x, v.z));
  const auto negative = V::Less(main, V::Set(0.0F));
  const auto base =
      V::SelectInts(along_y, V::SetInt(5), V::SelectInts(along_x, V::SetInt(1), V::SetInt(0)));
  const auto next =
      V::SelectInts(along_y, V::SetInt(4), V::SelectInts(along_x, V::SetInt(3), V::SetInt(2)));
  return {along_x,
          along_y,
          V::Select(negative, V::Set(-1.0F), V::Set(1.0F)),
          V::SelectInts(negative, next, base)};
}

template <typename V>
ORBWEAVE_LANES LaneVector<V> OnLaneFace(const LaneVector<V>& v, const LaneFace<V>& face) {
  const auto sx = V::Mul(face.sign, v.x);
  const auto sy = V::Mul(face.sign, v.y);
  const auto sz = V::Mul(face.sign, v.z);
  const auto minus_sz = V::Sub(V::Set(0.0F), sz);
  return {V::Select(face.along_y, v.x, V::Select(face.along_x, minus_sz, sx)),
          V::Select(face.along_y, minus_sz, v.y),
          V::Select(face.along_y, sy, V::Select(face.along_x, sx, sz))};
}

/// R r + t p, of the middle and of its derivatives.
template <typename V>
struct LaneRays {
  LaneVector<V> middle, by_column, by_row;
};

template <typename V>
ORBWEAVE_LANES typename V::Floats MulAdd(typename V::Floats a,
                                         typename V::Floats b,
                                         typename V::Floats c) {
  return V::Add(a, V::Mul(b, c));
}

template <typename V>
ORBWEAVE_LANES LaneRays<V> RaysOf(const ReferencePatches& patches,
                                  const MatchView& view,
                                  const PlaneLanes& planes,
                                  size_t lane,
                                  typename V::Floats& p0) {
  const auto x = V::Load(&patches.x[lane]);
  const auto y = V::Set(patches.y);
  const auto dx = V::Load(&patches.dx[lane]);
  const auto dy = V::Set(patches.dy);
  const auto qx = V::Load(&planes.x[lane]);
  const auto qy = V::Load(&planes.y[lane]);
  p0 = V::Add(V::Add(V::Mul(qx, x), V::Mul(qy, y)), V::Load(&planes.z[lane]));
  const auto pa = V::Mul(qx, dx);
  const auto pb = V::Mul(qy, dy);
  typename V::Floats m[3];
  typename V::Floats a[3];
  typename V::Floats b[3];
  for (size_t k = 0; k < 3; ++k) {
    const auto r0 = V::Set(view.rotation[3 * k]);
    const auto r1 = V::Set(view.rotation[3 * k + 1]);
    const auto r2 = V::Set(view.rotation[3 * k + 2]);
    const auto t = V::Set(view.translation[k]);
    m[k] = MulAdd<V>(V::Add(V::Add(V::Mul(r0, x), V::Mul(r1, y)), r2), t, p0);
    a[k] = MulAdd<V>(V::Mul(r0, dx), t, pa);
    b[k] = MulAdd<V>(V::Mul(r1, dy), t, pb);
  }
  return {{m[0], m[1], m[2]}, {a[0], a[1], a[2]}, {b[0], b[1], b[2]}};
}

/// Nothing where the patch is not `valid`: it would reach beyond the face.
template <typename V>
ORBWEAVE_LANES typename V::Ints FixedGrowth(typename V::Mask valid, typename V::Floats value) {
  return V::Truncate(V::Mul(V::Select(valid, value, V::Set(0.0F)), V::Set(kFixedOne)));
}

template <typename V>
ORBWEAVE_LANES typename V::Ints FixedPlace(typename V::Floats tangent, const MatchView& view) {
  const auto size = static_cast<float>(view.size_px);
  const float centre = (size - 1.0F) * 0.5F + kHalfStep;
  const float last = size - 1.0F - kReach_px;
  const auto at = V::Add(V::Mul(tangent, V::Set(view.focal_px)), V::Set(centre));
  const auto inside = V::Min(V::Max(at, V::Set(kReach_px)), V::Set(last));
  return V::Truncate(V::Mul(inside, V::Set(kFixedOne)));
}

template <typename V>
ORBWEAVE_LANES LaneWarp<V> WarpOfLanes(const LaneRays<V>& rays,
                                       const LaneFace<V>& face,
                                       const MatchView& view,
                                       typename V::Floats p0) {
  const LaneVector<V> s = OnLaneFace<V>(rays.middle, face);
  const LaneVector<V> a = OnLaneFace<V>(rays.by_column, face);
  const LaneVector<V> b = OnLaneFace<V>(rays.by_row, face);
  const auto inverse = V::Div(V::Set(1.0F), s.z);
  const auto u0 = V::Mul(s.x, inverse);
  const auto v0 = V::Mul(s.y, inverse);
  const auto scale = V::Mul(V::Set(view.focal_px), inverse);
  const auto ua = V::Mul(V::Sub(a.x, V::Mul(u0, a.z)), scale);
  const auto va = V::Mul(V::Sub(a.y, V::Mul(v0, a.z)), scale);
  const auto ub = V::Mul(V::Sub(b.x, V::Mul(u0, b.z)), scale);
  const auto vb = V::Mul(V::Sub(b.y, V::Mul(v0, b.z)), scale);
  const auto limit = V::Set(kMaxGrowth);
  const auto grows_little = V::And(V::Less(V::Add(V::Abs(ua), V::Abs(ub)), limit),
                                   V::Less(V::Add(V::Abs(va), V::Abs(vb)), limit));
  const auto valid = V::And(grows_little, V::Less(V::Set(0.0F), p0));
  return {FixedPlace<V>(u0, view),
          FixedPlace<V>(v0, view),
          FixedGrowth<V>(valid, ua),
          FixedGrowth<V>(valid, va),
          FixedGrowth<V>(valid, ub),
          FixedGrowth<V>(valid, vb),
          valid};
}

/// Grey level at a place, in the low half of each lane.
template <typename V>
ORBWEAVE_LANES typename V::Ints LevelAt(const uint32_t* quads,
                                        typename V::Ints size,
                                        typename V::Ints first,
                                        typename V::Ints u,
                                        typename V::Ints v) {
  const auto row = V::MulInts(V::template ShiftRight<16>(v), size);
  const auto quad =
      V::Gather(quads, V::AddInts(V::AddInts(row, first), V::template ShiftRight<16>(u)));
  const auto fx = V::AndInts(V::template ShiftRight<12>(u), V::SetInt(15));
  const auto fy = V::AndInts(V::template ShiftRight<12>(v), V::SetInt(15));
  const auto both = V::Mul16(fx, fy);
  const auto across = V::template ShiftRight<1>(V::AddInts(both, V::SetInt(1)));
  const auto right = V::SubInts(V::template ShiftLeft<3>(fx), across);
  const auto below = V::SubInts(V::template ShiftLeft<3>(fy), across);
  // 127 - right - below - across: below holds -across, too.
  const auto here = V::SubInts(V::SubInts(V::SetInt(127), right), V::template ShiftLeft<3>(fy));
  const auto weights =
      V::OrInts(V::OrInts(here, V::template ShiftLeft<8>(right)),
                V::OrInts(V::template ShiftLeft<16>(below), V::template ShiftLeft<24>(across)));
  return V::template ShiftRight<7>(V::SumPairs(V::SumBytePairs(quad, weights), V::SetInt(0x10001)));
}

template <typename V>
ORBWEAVE_LANES void MatchSome(const ReferencePatches& patches,
                              const MatchView& view,
                              const PlaneLanes& planes,
                              float noise_variance,
                              size_t lane,
                              float* zncc) {
  typename V::Floats p0;
  const LaneRays<V> rays = RaysOf<V>(patches, view, planes, lane, p0);
  const LaneFace<V> face = FaceOfLanes<V>(rays.middle);
  const LaneWarp<V> warp = WarpOfLanes<V>(rays, face, view, p0);
  const auto size = V::SetInt(view.size_px);
  const auto first = V::MulInts(face.index, V::SetInt(view.size_px * view.size_px));
  const auto five = V::SetInt(5);
  auto row_u = V::SubInts(warp.u, V::MulInts(five, V::AddInts(warp.u_by_column, warp.u_by_row)));
  auto row_v = V::SubInts(warp.v, V::MulInts(five, V::AddInts(warp.v_by_column, warp.v_by_row)));
  const auto column_u = V::template ShiftLeft<1>(warp.u_by_column);
  const auto column_v = V::template ShiftLeft<1>(warp.v_by_column);
  const auto next_row_u = V::template ShiftLeft<1>(warp.u_by_row);
  const auto next_row_v = V::template ShiftLeft<1>(warp.v_by_row);
  auto sum_s = V::SetInt(0);
  auto sum_ss = V::SetInt(0);
  auto sum_rs = V::SetInt(0);
  size_t pair = 0;
  for (int row = 0; row < 6; ++row) {
    auto u = row_u;
    auto v = row_v;
    for (int column = 0; column < 3; ++column, ++pair) {
      const auto low = LevelAt<V>(view.quads, size, first, u, v);
      u = V::AddInts(u, column_u);
      v = V::AddInts(v, column_v);
      const auto high = LevelAt<V>(view.quads, size, first, u, v);
      u = V::AddInts(u, column_u);
      v = V::AddInts(v, column_v);
      const auto levels = V::OrInts(low, V::template ShiftLeft<16>(high));
      const auto weights = V::LoadInts(&patches.weights[pair][lane]);
      const auto weighted = V::LoadInts(&patches.weighted[pair][lane]);
      sum_s = V::AddInts(sum_s, V::SumPairs(weights, levels));
      sum_ss = V::AddInts(sum_ss, V::SumPairs(V::Mul16(weights, levels), levels));
      sum_rs = V::AddInts(sum_rs, V::SumPairs(weighted, levels));
    }
    row_u = V::AddInts(row_u, next_row_u);
    row_v = V::AddInts(row_v, next_row_v);
  }
  const auto s = V::ToFloats(sum_s);
  const auto weight_sum = V::Load(&patches.weight_sum[lane]);
  const auto noise = V::Mul(V::Set(noise_variance), weight_sum);
  const auto scatter = V::Sub(V::ToFloats(sum_ss), V::Div(V::Mul(s, s), weight_sum));
  const auto bound = V::Mul(V::Add(V::Max(scatter, V::Set(0.0F)), noise),
                            V::Add(V::Load(&patches.scatter[lane]), noise));
  const auto covariance = V::Sub(V::ToFloats(sum_rs), V::Mul(V::Load(&patches.mean[lane]), s));
  const auto score = V::Div(covariance, V::Sqrt(bound));
  V::Store(zncc, V::Select(warp.valid, score, V::Set(kNoMatch)));
  if (view.ignored == nullptr) return;
  const auto tiles = V::SetInt(view.tiles);
  const auto tile_row =
      V::AddInts(V::MulInts(face.index, tiles), V::template ShiftRight<18>(warp.v));
  alignas(64) int32_t tile[V::kWidth];
  V::StoreInts(tile, V::AddInts(V::MulInts(tile_row, tiles), V::template ShiftRight<18>(warp.u)));
  for (size_t k = 0; k < V::kWidth; ++k) {
    if (view.ignored[tile[k]] != 0) zncc[k] = kNoMatch;
  }
}

template <typename V>
ORBWEAVE_LANES void MatchLanes(const ReferencePatches& patches,
                               const MatchView& view,
                               const PlaneLanes& planes,
                               float noise_variance,
                               LaneFloats& zncc) {
  for (size_t lane = 0; lane < kMatchLanes; lane += V::kWidth) {
    MatchSome<V>(patches, view, planes, noise_variance, lane, zncc.data() + lane);
  }
}

}  // namespace orbweave::internal
