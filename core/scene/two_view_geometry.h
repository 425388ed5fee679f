// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/options.h"
#include "core/geometry/rigid3.h"
#include "core/scene/ids.h"

namespace orbweave {

enum class TwoViewKind : uint8_t {
  kNone = 0,          ///< no geometry fits: too few matches or inliers
  kGeneral = 1,       ///< rotation and direction of translation
  kPureRotation = 2,  ///< same centre: the translation is noise
  kPlanar = 3,        ///< general, but nearly all inliers lie on one plane
};

/// Whether a pair of this kind says where one camera lies from the other.
[[nodiscard]] constexpr bool HasBaseline(TwoViewKind kind) {
  return kind == TwoViewKind::kGeneral || kind == TwoViewKind::kPlanar;
}

/// How the matches of a pair were found: the rungs of a ladder, each tried where those before it
/// find no evidence.
enum class MatchRung : uint8_t {
  kGiven = 0,        ///< matches from outside
  kDescriptors = 1,  ///< nearest descriptors, a pose by minimal samples of any orientation
  kUpright = 2,      ///< the same matches, by samples of cameras that stand upright
  kGuided = 3,       ///< too little by themselves; what they predict was found along the planes
  kLargest = 4,      ///< tried first: as kDescriptors, of the features of the largest scales alone
  kFacades = 5,      ///< with nearest descriptors of facade views, of any orientation or upright
  kPropagated = 6,   ///< matched again under the rotation that two other pairs predict
};
constexpr size_t kNumMatchRungs = 7;

template <>
struct EnumNames<MatchRung> {
  static constexpr std::array<std::pair<MatchRung, std::string_view>, kNumMatchRungs> kNames = {
      {{MatchRung::kGiven, "given"},
       {MatchRung::kDescriptors, "descriptors"},
       {MatchRung::kUpright, "upright_samples"},
       {MatchRung::kGuided, "predicted_matches"},
       {MatchRung::kLargest, "largest_features"},
       {MatchRung::kFacades, "facades"},
       {MatchRung::kPropagated, "propagated"}}};
};

/// What two panoramas say about each other.
struct TwoViewGeometry {
  ImagePair pair{};
  TwoViewKind kind = TwoViewKind::kNone;
  Rigid3 b_from_a{};                    ///< |translation| = 1, or 0 for kPureRotation
  std::vector<FeatureMatch> inliers{};  ///< sorted
  uint32_t num_putative = 0;            ///< matches before verification
  /// Evidence that the pair shows one scene: log10 of how many pairs of images that have nothing in
  /// common would look as well matched (core/estimators/match_evidence.h).
  double log10_false_alarms = 0.0;
  MatchRung rung = MatchRung::kGiven;
  double median_angle_rad = 0.0;  ///< median triangulation angle of the inliers
  /// Share of the equal-area cells of the sphere (core/geometry/sphere_cells.h, 8 x 8 cells)
  /// in image a that hold an inlier: 0 ... 1.
  double spread = 0.0;
};

}  // namespace orbweave
