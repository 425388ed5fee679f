// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/geometry/sim3.h"
#include "core/merging/georeference/estimate_gravity.h"

namespace orbweave {

/// Camera centres, what GNSS says of them, and its sigma per axis (unknown heights:
/// kUnknownHeightSigma_m); all of one length.
struct PositionPairs {
  std::span<const Eigen::Vector3d> in_world{};
  std::span<const Eigen::Vector3d> in_enu{};
  std::span<const Eigen::Vector3d> sigma_m{};
};

/// Seven parameters by Gauss-Newton steps from `start`: minimises
///   sum_i rho(|(T p_i - q_i) / sigma_i|^2) + inflation |R g + e_up|^2 / SigmaAt(angle)^2,
/// rho Cauchy's at one, or at the scatter found along the ground where that is above it, so that a
/// start whose ends are far off comes in. Unknown heights take no part: hills are not to be laid
/// flat. `inflation`: so many positions are worth one (EstimatePositionNoise). Gravity is a
/// direction: it turns the model about level axes, and pulls neither at its heading nor at its
/// scale. What neither positions nor gravity tell (the roll about a straight line without gravity)
/// stays as it is in `start`.
[[nodiscard]] Sim3 RefineGeoreference(const PositionPairs& pairs,
                                      const std::optional<Gravity>& gravity,
                                      double inflation,
                                      const Sim3& start);

}  // namespace orbweave
