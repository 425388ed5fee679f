// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/refine_extremum.h"

#include <cmath>

#include "core/features/sift/octave_plan.h"

namespace orbweave::internal {
namespace {

constexpr int kMaxMoves = 4;
constexpr float kGreys = 255.0F;

using Levels = std::array<const RowRing*, kSiftLevels>;
using Cube = std::array<std::array<std::array<float, 3>, 3>, 3>;  ///< scale, row, column

Cube DifferencesAbout(const Levels& levels, const SiftHit& at) {
  Cube cube;
  for (int k = 0; k < 3; ++k) {
    const auto fine = static_cast<size_t>(at.scale - 1 + k);
    for (int j = 0; j < 3; ++j) {
      const float* const a = levels[fine]->Row(at.row - 1 + j) + at.column - 1;
      const float* const b = levels[fine + 1]->Row(at.row - 1 + j) + at.column - 1;
      for (size_t i = 0; i < 3; ++i)
        cube[static_cast<size_t>(k)][static_cast<size_t>(j)][i] = b[i] - a[i];
    }
  }
  return cube;
}

/// Value, gradient and second derivatives in the middle of a cube.
struct Quadratic {
  float value, x, y, s, xx, yy, ss, xy, xs, ys;
};

/// Every derivative changes its sign alone, not its bits, where the cube is mirrored.
Quadratic QuadraticOf(const Cube& d) {
  const float v = d[1][1][1];
  return {.value = v,
          .x = 0.5F * (d[1][1][2] - d[1][1][0]),
          .y = 0.5F * (d[1][2][1] - d[1][0][1]),
          .s = 0.5F * (d[2][1][1] - d[0][1][1]),
          .xx = (d[1][1][2] + d[1][1][0]) - 2.0F * v,
          .yy = (d[1][2][1] + d[1][0][1]) - 2.0F * v,
          .ss = (d[2][1][1] + d[0][1][1]) - 2.0F * v,
          .xy = 0.25F * ((d[1][2][2] - d[1][2][0]) - (d[1][0][2] - d[1][0][0])),
          .xs = 0.25F * ((d[2][1][2] - d[2][1][0]) - (d[0][1][2] - d[0][1][0])),
          .ys = 0.25F * ((d[2][2][1] - d[2][0][1]) - (d[0][2][1] - d[0][0][1]))};
}

struct Offset {
  float x, y, s;
};

/// Where the gradient vanishes, by Cramer's rule; none where that is nowhere near.
std::optional<Offset> TopOf(const Quadratic& q) {
  const float a = q.yy * q.ss - q.ys * q.ys;
  const float b = q.xs * q.ys - q.xy * q.ss;
  const float c = q.xy * q.ys - q.yy * q.xs;
  const float determinant = q.xx * a + q.xy * b + q.xs * c;
  const float factor = -1.0F / determinant;
  const float ys = q.xy * q.xs - q.xx * q.ys;
  const Offset top = {factor * (a * q.x + b * q.y + c * q.s),
                      factor * (b * q.x + (q.xx * q.ss - q.xs * q.xs) * q.y + ys * q.s),
                      factor * (c * q.x + ys * q.y + (q.xx * q.yy - q.xy * q.xy) * q.s)};
  const auto is_near = [](float move) { return std::abs(move) < 100.0F; };  // false for no number
  if (!is_near(top.x) || !is_near(top.y) || !is_near(top.s)) return std::nullopt;
  return top;
}

bool IsEdge(const Quadratic& q, double edge) {
  const float trace = q.xx + q.yy;
  const float determinant = q.xx * q.yy - q.xy * q.xy;
  const auto r = static_cast<float>(edge);
  return determinant <= 0.0F || trace * trace * r >= (r + 1.0F) * (r + 1.0F) * determinant;
}

int Step(float offset) { return offset > 0.5F ? 1 : offset < -0.5F ? -1 : 0; }

}  // namespace

std::optional<SiftPosition> RefineExtremum(const Levels& levels,
                                           const SiftHit& hit,
                                           const SiftThresholds& thresholds) {
  static_assert(kMaxMoves + 1 < kRefinementReach);
  SiftHit at = hit;
  for (int moves = 0; moves <= kMaxMoves; ++moves) {
    const Quadratic q = QuadraticOf(DifferencesAbout(levels, at));
    const std::optional<Offset> top = TopOf(q);
    if (!top.has_value()) return std::nullopt;
    if (Step(top->x) == 0 && Step(top->y) == 0 && Step(top->s) == 0) {
      const float contrast =
          std::abs(q.value + 0.5F * (q.x * top->x + q.y * top->y + q.s * top->s)) / kGreys;
      if (contrast * kSiftScales < static_cast<float>(thresholds.contrast) ||
          IsEdge(q, thresholds.edge))
        return std::nullopt;
      return SiftPosition{.column = at.column,
                          .row = at.row,
                          .scale = at.scale,
                          .dx = top->x,
                          .dy = top->y,
                          .dscale = top->s,
                          .response = contrast};
    }
    at.column += Step(top->x);
    at.row += Step(top->y);
    at.scale += Step(top->s);
    if (at.scale < 1 || at.scale > kSiftScales) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace orbweave::internal
