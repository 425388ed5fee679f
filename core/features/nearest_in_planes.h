// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/features/axial_features.h"
#include "core/features/distance_kernels.h"
#include "core/features/find_nearest_two.h"
#include "core/features/nearest_two.h"
#include "core/features/pair_side.h"

namespace orbweave {

/// The nearest features of two panoramas by descriptor among those whose bearings lie within an
/// angle of each other's epipolar plane and in front of both spheres. One baseline, any rotation:
/// what the baseline alone asks for is prepared once. Of equally near ones any is the nearest, the
/// same on every machine.
class NearestInPlanes {
 public:
  /// `baseline_in_b`: b_from_a.translation, not zero. Both sides have descriptors, and outlive
  /// this.
  NearestInPlanes(const PairSide& a,
                  const PairSide& b,
                  const Eigen::Vector3d& baseline_in_b,
                  double max_error_rad,
                  DistanceKernel kernel = AvailableDistanceKernels().back());

  [[nodiscard]] NearestTwoBothWays Find(const Eigen::Quaterniond& b_from_a) const;

 private:
  const PairSide& a_;
  Eigen::Quaterniond axial_from_b_;
  AngularError max_error_;
  DistanceKernel kernel_;
  AxialFeatures axial_b_;
  std::vector<internal::DescriptorBlock> blocks_b_;  ///< in the order of axial_b_
};

}  // namespace orbweave
