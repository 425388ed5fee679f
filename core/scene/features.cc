// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/features.h"

namespace orbweave {

std::vector<Eigen::Vector3d> BearingsOf(const Features& features) {
  std::vector<Eigen::Vector3d> bearings(features.size());
  for (FeatureIndex i = 0; i < bearings.size(); ++i) bearings[i] = features.Bearing(i);
  return bearings;
}

}  // namespace orbweave
