// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// How far a mount may lean whose lean nobody states: poles on roofs and in hands stand within some
/// degrees, and one that leans by 12 is no marvel.
inline constexpr double kMountSigma_rad = 0.1;

/// Panoramas that lean further are not upright on average: 30 degrees, as in FindGravity.
inline constexpr double kMaxLean_rad = 0.5236;

/// Where down is, as the attitudes of the panoramas alone say.
struct Gravity {
  Eigen::Vector3d down_in_world = -Eigen::Vector3d::UnitZ();
  /// In any direction: kMountSigma_rad where all panoramas look the same way, less where drives
  /// turn.
  double sigma_rad = kMountSigma_rad;
  /// What share of the information that mounts stand upright is; 1 where nothing turns.
  double mount_share = 1.0;
  /// Per drive the mean of down in the cameras, unit: what its mount makes of it, after what is
  /// stated of each panorama is taken off.
  std::map<uint32_t, Eigen::Vector3d> down_in_mount{};
  /// Standard deviation of each of these in any direction, that of down included.
  std::map<uint32_t, double> mount_sigma_rad{};

  /// Where GNSS finds down `away_rad` from here, mounts lean more than most: as with Cauchy's loss
  /// they then count for less, down to a third: none leans much further than kMaxLean_rad. What
  /// turns tell counts as before.
  [[nodiscard]] double SigmaAt(double away_rad) const {
    return std::hypot(sigma_rad, mount_share * std::min(away_rad, kMaxLean_rad));
  }
};

/// The carrier of a drive keeps upright but for slopes, its mount leans by an unknown but constant
/// rotation: so down, seen from the cameras of a drive, is one direction d_k, wherever they look,
/// and the one direction g of the world that stays where the cameras turn is down. Minimises
///   sum_i e_i^T W_i e_i + sum_k rho'(|d_k - y|^2),   e_i = R_i g - d_k,   |g| = 1,
/// over g and all d_k. W_i weighs what leans along the way, as slopes make it, and what leans
/// across it by themselves: Cauchy's weights at the scatter found of each. On hills what leans
/// across tells g where the street turns, and what leans along it next to nothing. rho' is Cauchy's
/// at kMountSigma_rad: most mounts stand upright, some lean far. In a street without turns the
/// second term decides ("cameras are upright"), with its sigma. Slopes keep a drive from knowing
/// d_k to better than a degree, or than what neighbours lean alike, and ground that slopes as a
/// whole keeps all of them from knowing g to better than three. Slopes that come with turns look
/// like a mount that leans: both are tried, a mount is taken where it leaves next to nothing that
/// neighbours lean alike, and where it may be either the sigma has half of what lies between. Where
/// enough of a drive's panoramas state pitch and roll (DriveAttitudes), R_i is that from the world
/// into a level camera, and d_k is within their tilt_sigma_deg. Panoramas that keep their heading
/// while the drive turns (DriveAttitudes::keeps_heading) were levelled by what turned them: their
/// d_k is y within three degrees.
///
/// nullopt where panoramas are not upright on average (FindGravity) or there are none.
[[nodiscard]] std::optional<Gravity> EstimateGravity(const Reconstruction& reconstruction,
                                                     const ImageManifest& manifest);

}  // namespace orbweave
