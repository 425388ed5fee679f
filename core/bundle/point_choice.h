// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace orbweave {

/// Half the sum of losses of a point's observations, and whether it lies behind a panorama.
struct PointCost {
  double cost = 0.0;
  bool any_behind = false;
};

/// Shares of its step that a point may take: all, and what is tried after a leap.
inline constexpr std::array<double, 3> kStepShares = {1.0, 0.25, 0.0};

struct PointChoice {
  size_t share = 0;  ///< index into kStepShares
  double cost = 0.0;
};

/// A point whose step was a leap, because rays are nearly parallel (it falls behind a panorama, or
/// its cost rises by more than one sigma^2 per observation), stays where it is when that is
/// cheaper: one such point cannot spoil the step of all others. `cost_at(i)` is its PointCost after
/// the share kStepShares[i] of its step.
template <typename CostAt>
[[nodiscard]] PointChoice ChoosePointStep(double cost_before, const CostAt& cost_at) {
  constexpr double kLeap = 0.1;  // rise of the cost that calls for a shorter step
  PointChoice choice;
  PointCost now = cost_at(size_t{0});
  for (size_t i = 1; i < kStepShares.size(); ++i) {
    if (!now.any_behind && now.cost <= cost_before + kLeap) break;
    const PointCost other = cost_at(i);
    if (now.cost <= other.cost) continue;
    now = other;
    choice.share = i;
  }
  choice.cost = now.cost;
  return choice;
}

}  // namespace orbweave
