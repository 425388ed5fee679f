// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>

#include "core/dense/match_kernels.h"
#include "core/dense/source_faces.h"

namespace orbweave::internal {
namespace {

struct Vector {
  float x, y, z;
};

/// The first of two, unless the second is larger or the first is no number.
float LargerOf(float a, float b) { return a > b ? a : b; }
float SmallerOf(float a, float b) { return a < b ? a : b; }

/// A face of the cube (cube_face.h).
struct Face {
  int index;
  bool along_x, along_y, negative;
};

Face FaceOfVector(const Vector& v) {
  const float ax = std::abs(v.x);
  const float ay = std::abs(v.y);
  const float az = std::abs(v.z);
  const bool along_y = ay > ax && ay > az;
  const bool along_x = !along_y && ax > az;
  const bool negative = (along_y ? v.y : along_x ? v.x : v.z) < 0.0F;
  const int base = along_y ? 5 : along_x ? 1 : 0;
  const int step = along_y ? -1 : 2;
  return {negative ? base + step : base, along_x, along_y, negative};
}

/// Of the source's frame in that of the face.
Vector OnFace(const Vector& v, const Face& face) {
  const float sign = face.negative ? -1.0F : 1.0F;
  if (face.along_y) return {v.x, -sign * v.z, sign * v.y};
  if (face.along_x) return {-sign * v.z, v.y, sign * v.x};
  return {sign * v.x, v.y, sign * v.z};
}

/// Position of a patch in a face: fixed point, of its middle and by a column and a row.
struct Warp {
  bool valid;
  int32_t u, v, u_by_column, v_by_column, u_by_row, v_by_row;
  int32_t first;  // of the face in quads
  int32_t tile;   // of the middle, in SourceFaces::ignored
};

int32_t Fixed(float value) { return static_cast<int32_t>(value * kFixedOne); }

Warp WarpOf(const ReferencePatches& patches,
            const MatchView& view,
            const PlaneLanes& planes,
            size_t lane) {
  const auto& R = view.rotation;
  const auto& t = view.translation;
  const float x = patches.x[lane];
  const float dx = patches.dx[lane];
  const float qx = planes.x[lane];
  const float qy = planes.y[lane];
  const float p0 = qx * x + qy * patches.y + planes.z[lane];
  const float pa = qx * dx;
  const float pb = qy * patches.dy;
  const auto middle = [&](size_t k) {
    return R[3 * k] * x + R[3 * k + 1] * patches.y + R[3 * k + 2] + t[k] * p0;
  };
  const auto by_column = [&](size_t k) { return R[3 * k] * dx + t[k] * pa; };
  const auto by_row = [&](size_t k) { return R[3 * k + 1] * patches.dy + t[k] * pb; };
  const Vector m = {middle(0), middle(1), middle(2)};
  const Face face = FaceOfVector(m);
  const Vector s = OnFace(m, face);
  const Vector a = OnFace({by_column(0), by_column(1), by_column(2)}, face);
  const Vector b = OnFace({by_row(0), by_row(1), by_row(2)}, face);
  const float inverse = 1.0F / s.z;
  const float u0 = s.x * inverse;
  const float v0 = s.y * inverse;
  const float scale = view.focal_px * inverse;
  const float ua = (a.x - u0 * a.z) * scale;
  const float va = (a.y - v0 * a.z) * scale;
  const float ub = (b.x - u0 * b.z) * scale;
  const float vb = (b.y - v0 * b.z) * scale;
  const auto size = static_cast<float>(view.size_px);
  const float centre = (size - 1.0F) * 0.5F + kHalfStep;
  const float last = size - 1.0F - kReach_px;
  const float u = SmallerOf(LargerOf(u0 * view.focal_px + centre, kReach_px), last);
  const float v = SmallerOf(LargerOf(v0 * view.focal_px + centre, kReach_px), last);
  const bool valid = std::abs(ua) + std::abs(ub) < kMaxGrowth &&
                     std::abs(va) + std::abs(vb) < kMaxGrowth && p0 > 0.0F;
  const auto grown = [&](float value) { return valid ? Fixed(value) : 0; };
  Warp warp{valid,
            Fixed(u),
            Fixed(v),
            grown(ua),
            grown(va),
            grown(ub),
            grown(vb),
            face.index * view.size_px * view.size_px,
            0};
  warp.tile = (face.index * view.tiles + (warp.v >> 18)) * view.tiles + (warp.u >> 18);
  return warp;
}

int32_t Level(const MatchView& view, int32_t first, int32_t u, int32_t v) {
  const uint32_t quad = view.quads[first + (v >> 16) * view.size_px + (u >> 16)];
  const int32_t fx = (u >> 12) & 15;
  const int32_t fy = (v >> 12) & 15;
  const int32_t both = fx * fy;
  const int32_t across = (both + 1) >> 1;  // rounded so that no weight is negative
  const int32_t right = (fx << 3) - across;
  const int32_t below = (fy << 3) - across;
  const int32_t here = 127 - right - below - across;
  return (here * static_cast<int32_t>(quad & 255) + right * static_cast<int32_t>(quad >> 8 & 255) +
          below * static_cast<int32_t>(quad >> 16 & 255) +
          across * static_cast<int32_t>(quad >> 24)) >>
         7;
}

}  // namespace

void MatchPortable(const ReferencePatches& patches,
                   const MatchView& view,
                   const PlaneLanes& planes,
                   float noise_variance,
                   LaneFloats& zncc) {
  static_assert(SourceFaces::kTile_px == 4);
  for (size_t lane = 0; lane < kMatchLanes; ++lane) {
    const Warp warp = WarpOf(patches, view, planes, lane);
    int32_t sum_s = 0;
    int32_t sum_ss = 0;
    int32_t sum_rs = 0;
    int32_t row_u = warp.u - 5 * (warp.u_by_column + warp.u_by_row);
    int32_t row_v = warp.v - 5 * (warp.v_by_column + warp.v_by_row);
    size_t pair = 0;
    for (int row = 0; row < 6; ++row) {
      int32_t u = row_u;
      int32_t v = row_v;
      for (int column = 0; column < 3; ++column, ++pair) {
        for (int half = 0; half < 2; ++half) {
          const int shift = 16 * half;
          const int32_t w = (patches.weights[pair][lane] >> shift) & 0xFFFF;
          const int32_t wr = (patches.weighted[pair][lane] >> shift) & 0xFFFF;
          const int32_t s = Level(view, warp.first, u, v);
          sum_s += w * s;
          sum_ss += w * s * s;
          sum_rs += wr * s;
          u += 2 * warp.u_by_column;
          v += 2 * warp.v_by_column;
        }
      }
      row_u += 2 * warp.u_by_row;
      row_v += 2 * warp.v_by_row;
    }
    const auto s = static_cast<float>(sum_s);
    const float noise = noise_variance * patches.weight_sum[lane];
    const float scatter = static_cast<float>(sum_ss) - s * s / patches.weight_sum[lane];
    const float bound = (LargerOf(scatter, 0.0F) + noise) * (patches.scatter[lane] + noise);
    const float score = (static_cast<float>(sum_rs) - patches.mean[lane] * s) / std::sqrt(bound);
    const bool valid = warp.valid && (view.ignored == nullptr || view.ignored[warp.tile] == 0);
    zncc[lane] = valid ? score : kNoMatch;
  }
}

}  // namespace orbweave::internal
