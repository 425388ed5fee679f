// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace orbweave {

struct BundleReport {
  double initial_cost = 0.0;  ///< half the sum of losses
  double final_cost = 0.0;
  int iterations = 0;
  bool converged = false;
  std::vector<Eigen::Vector3d> biases_m{};
};

}  // namespace orbweave
