// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "core/mapping/bridges/fit_bridge.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Relative rotations and directions of weak pairs, those that are left between submodels, are
/// good to so much: triplets of right ones close to within 5 degrees.
constexpr double kTurnSigmaRad = 3.0 * (std::numbers::pi / 180.0);
constexpr double kDirectionSigmaRad = 5.0 * (std::numbers::pi / 180.0);

/// A verified pair with one image in each of two submodels.
struct BridgePair {
  uint32_t pair = 0;  ///< into graph.pairs
  ImageSlot in_a = 0;
  ImageSlot in_b = 0;
  size_t matches = 0;
  Eigen::Quaterniond a_from_b = Eigen::Quaterniond::Identity();  ///< submodel frames, by this pair
  /// Direction of the camera in b from that in a, unit, in that one's frame; zero: a pure rotation.
  Eigen::Vector3d direction_in_cam_a = Eigen::Vector3d::Zero();
};

/// Those between two submodels of one cluster, by index.
[[nodiscard]] std::vector<BridgePair> BridgePairsOf(const MappingState& a, const MappingState& b);

/// The pairs that agree about how the submodels are turned with the one that most matches agree
/// with: within `max_turn_rad` of it.
[[nodiscard]] std::vector<BridgePair> PairsThatTurnAlike(const std::vector<BridgePair>& pairs,
                                                         double max_turn_rad);

/// What those pairs, the scene points that their matches show, and the GNSS positions of the images
/// `fixed` of b say (BridgeTerms), with the origin of b moved to `origin_in_b`. `enu_from_a`
/// nullopt: no GNSS. `max_error_px` nullopt: without the points.
[[nodiscard]] BridgeTerms TermsOf(const MappingState& a,
                                  const MappingState& b,
                                  const std::vector<BridgePair>& pairs,
                                  const Eigen::Vector3d& origin_in_b,
                                  std::span<const ImageSlot> fixed,
                                  const std::optional<Sim3>& enu_from_a,
                                  std::optional<double> max_error_px);

/// Lengths of a pair's baseline in the units of either submodel: the median over the points of
/// that submodel which the other camera sees, each the length at which its ray comes nearest to
/// the point. Zero: too few points say.
struct BridgeLengths {
  double in_a = 0.0;
  double in_b = 0.0;
};
[[nodiscard]] BridgeLengths LengthsOf(const MappingState& a,
                                      const MappingState& b,
                                      const BridgePair& pair);

}  // namespace orbweave
