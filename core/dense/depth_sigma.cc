// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/depth_sigma.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orbweave {
namespace {

constexpr float kIndependentTaps = 12.0F;
constexpr float kFloor_px = 0.04F;
constexpr float kLeastCurvature = 1e-4F;

}  // namespace

CostMinimum FindMinimum(float held, float nearer, float farther, float step, float step_px) {
  const float second = nearer - 2.0F * held + farther;
  const float at = 0.5F * (farther - nearer) / second;
  if (!(second > kLeastCurvature) || std::abs(at) > 1.5F) {
    const float none = std::numeric_limits<float>::infinity();
    if (nearer < held && nearer <= farther) return {step, none, nearer};
    if (farther < held) return {-step, none, farther};
    return {0.0F, none, held};
  }
  const float cost = held - 0.5F * second * at * at;
  const float variance = 2.0F * std::max(cost, 0.002F) / (kIndependentTaps * second);
  const float floor = kFloor_px / step_px;
  return {at * step, step * std::sqrt(variance + floor * floor), cost};
}

}  // namespace orbweave
