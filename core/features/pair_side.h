// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/scene/features.h"

namespace orbweave {

/// A panorama made ready to be matched with others: what each of its pairs needs, computed once.
struct PairSide {
  explicit PairSide(Features image_features);

  Features features;
  std::vector<Eigen::Vector3d> bearings;  ///< BearingsOf(features)
  /// Features by scale, the largest first; of equal scales that of the lower index.
  std::vector<FeatureIndex> by_scale;
  std::vector<uint8_t> descriptors_by_scale;  ///< in the order of by_scale; empty without any
  std::vector<int32_t> squared_norms;         ///< of the descriptors of `features`
};

}  // namespace orbweave
