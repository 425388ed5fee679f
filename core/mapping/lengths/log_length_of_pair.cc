// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/log_length_of_pair.h"

#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

constexpr double kMaxTurn_rad = 10.0 / 180.0 * std::numbers::pi;

}  // namespace

Rigid3 PoseInModel(const MappingState& state, const LinkedPair& pair) {
  return state.CamFromWorld(pair.b) * state.CamFromWorld(pair.a).Inverse();
}

bool HasRotationOfModel(const MappingState& state, const LinkedPair& pair) {
  const TwoViewGeometry& geometry = state.Problem().pairs[pair.index];
  return state.IsRegistered(pair.a) && state.IsRegistered(pair.b) &&
         geometry.kind == TwoViewKind::kGeneral &&
         geometry.b_from_a.rotation.angularDistance(PoseInModel(state, pair).rotation) <=
             kMaxTurn_rad;
}

std::optional<double> LogLengthOfPair(const MappingState& state, const LinkedPair& pair) {
  if (!HasRotationOfModel(state, pair)) return std::nullopt;
  const Eigen::Vector3d step = PoseInModel(state, pair).Centre();
  const Eigen::Vector3d direction =
      state.Problem().pairs[pair.index].b_from_a.Centre().normalized();
  const double length = step.norm();
  if (!(length > 0.0) || direction.dot(step) < kMinCosDirection * length) return std::nullopt;
  return std::log(length);
}

}  // namespace orbweave
