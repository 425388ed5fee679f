// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/moves_along.h"

#include <algorithm>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

constexpr double kStandingShare = 0.3;

}  // namespace

std::vector<MoveAlong> MovesAlong(std::span<const Eigen::Vector3d> places) {
  std::vector<MoveAlong> moves(places.size());
  if (places.size() < 2) return moves;
  std::vector<double> steps;
  for (size_t i = 1; i < places.size(); ++i) steps.push_back((places[i] - places[i - 1]).norm());
  const double least = kStandingShare * Quantile(std::move(steps), 0.5);
  for (size_t i = 0; i < places.size(); ++i) {
    MoveAlong& move = moves[i];
    move.first = i > 0 ? i - 1 : i;
    move.last = std::min(i + 1, places.size() - 1);
    const Eigen::Vector3d moved = places[move.last] - places[move.first];
    if (moved.norm() > static_cast<double>(move.last - move.first) * least) move.moved = moved;
  }
  return moves;
}

}  // namespace orbweave
