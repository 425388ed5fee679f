// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/moves_along.h"

#include <algorithm>

#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr double kStandingShare = 0.3;
constexpr double kUsualSteps = 3.0;  // as in LeftOffBehind

/// Per step whether the carrier was elsewhere in between: it is longer than three usual ones and
/// than three of either beside it.
std::vector<uint8_t> FindGaps(const std::vector<double>& steps, double usual_step) {
  std::vector<uint8_t> is_gap(steps.size(), 0);
  for (size_t i = 0; i < steps.size(); ++i) {
    const double before = i > 0 ? steps[i - 1] : 0.0;
    const double behind = i + 1 < steps.size() ? steps[i + 1] : 0.0;
    is_gap[i] = steps[i] > kUsualSteps * std::max({usual_step, before, behind}) ? 1 : 0;
  }
  return is_gap;
}

}  // namespace

std::vector<MoveAlong> MovesAlong(std::span<const Eigen::Vector3d> places) {
  std::vector<MoveAlong> moves(places.size());
  if (places.size() < 2) return moves;
  std::vector<double> steps;
  for (size_t i = 1; i < places.size(); ++i) steps.push_back((places[i] - places[i - 1]).norm());
  const double usual_step = UsualStep(steps);
  const std::vector<uint8_t> is_gap = FindGaps(steps, usual_step);
  const double least = kStandingShare * usual_step;
  for (size_t i = 0; i < places.size(); ++i) {
    MoveAlong& move = moves[i];
    move.first = i > 0 && !is_gap[i - 1] ? i - 1 : i;
    move.last = i < is_gap.size() && !is_gap[i] ? i + 1 : i;
    const Eigen::Vector3d moved = places[move.last] - places[move.first];
    if (moved.norm() > static_cast<double>(move.last - move.first) * least) move.moved = moved;
  }
  return moves;
}

}  // namespace orbweave
