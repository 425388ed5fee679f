// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace orbweave {

/// Errors of points, and what was found of a surface.
class DepthScore {
 public:
  /// A point so far from the true surface, and `along_m` off along its ray.
  void AddPoint(double error_m, double along_m, double sigma_m);

  /// A place of the surface that two panoramas see, and how far a point of it is off; negative:
  /// nothing was found.
  void AddPlace(double error_m);

  /// One line: precision and recall (where places were added) at 2, 5 and 10 cm in percent, the
  /// median, and what lies within one and two sigmas.
  void Print(const std::string& what) const;

 private:
  std::vector<double> errors_m_{};
  size_t within_one_sigma_ = 0;
  size_t within_two_sigmas_ = 0;
  size_t places_ = 0;
  std::array<size_t, 3> found_{};
};

}  // namespace orbweave
