// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/rigid3.h"
#include "core/scene/features.h"
#include "core/scene/ids.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// Matches of a pair as a matcher would find them, wrong ones among them; sorted.
struct PairMatches {
  ImagePair pair{};
  std::vector<FeatureMatch> matches{};
};

/// What features of the carrier show instead of an index into points_in_world: kCarrierPoint + k
/// for spot k of its roof, at the same place of every panorama.
constexpr uint32_t kCarrierPoint = 0x80000000U;

struct Corridor {
  ImageManifest manifest{};
  std::vector<Features> features{};  ///< by image
  std::vector<PairMatches> pairs{};  ///< sorted by pair
  std::vector<Rigid3>
      cams_from_world{};  ///< truth; world is east-north-up metres at the manifest's origin
  std::vector<Eigen::Vector3d> points_in_world{};
  /// By point: points of one appearance are copies that a matcher cannot tell apart.
  std::vector<uint32_t> appearance_of_point{};
  /// By image and feature, ascending: index into points_in_world, or from kCarrierPoint on.
  std::vector<std::vector<uint32_t>> point_of_feature{};
};

}  // namespace orbweave
