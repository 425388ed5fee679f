// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/facade_view.h"
#include "core/scene/features.h"

namespace orbweave {

/// A panorama made ready to be matched with others: what each of its pairs needs, computed once.
/// Features of facade views come last; they are matched for themselves (MatchFacades), as they show
/// what others show again.
struct PairSide {
  explicit PairSide(Features image_features);

  Features features;
  std::vector<Eigen::Vector3d> bearings;  ///< BearingsOf(features)
  size_t num_plain = 0;                   ///< features of the panorama itself
  /// These by scale, the largest first; of equal scales that of the lower index.
  std::vector<FeatureIndex> by_scale;
  std::vector<uint8_t> descriptors_by_scale;  ///< in the order of by_scale; empty without any
  std::vector<int32_t> squared_norms;         ///< of the descriptors of `features`
  /// Where the features of each facade view begin; the last one ends with all.
  std::array<size_t, kNumFacadeViews + 1> first_of_view{};

  [[nodiscard]] bool HasFacades() const { return num_plain < features.size(); }
  [[nodiscard]] std::span<const Eigen::Vector3d> PlainBearings() const {
    return std::span(bearings).first(num_plain);
  }
};

}  // namespace orbweave
