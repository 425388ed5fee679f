// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/geometry/rotation.h"
#include "core/geometry/sim3.h"

namespace orbweave {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

/// Coordinates x = (w, lambda, d) of the similarities near `a_from_b`, all seven without unit:
///
///   rotation  Exp(w) R        scale  exp(lambda) s        anchor goes to  a_from_b * anchor +
///   length d
///
/// The anchor is a point amid the data, so that turning and growing leave it in place, and the
/// length is their extent: uncertainties of the seven coordinates are then comparable, and
/// independent of the origin and the scale of both frames.
struct SimilarityChart {
  Sim3 a_from_b{};
  Eigen::Vector3d anchor_in_b = Eigen::Vector3d::Zero();
  double length_in_a = 1.0;

  /// The similarity with coordinates x.
  [[nodiscard]] Sim3 At(const Vector7d& x) const {
    const Eigen::Quaterniond R = (RotationFromVector(x.head<3>()) * a_from_b.rotation).normalized();
    const double s = a_from_b.scale * std::exp(x[3]);
    const Eigen::Vector3d anchor_in_a = a_from_b * anchor_in_b + length_in_a * x.tail<3>();
    return {s, R, anchor_in_a - s * (R * anchor_in_b)};
  }

  /// The coordinates of a similarity, |w| <= pi.
  [[nodiscard]] Vector7d Of(const Sim3& other_a_from_b) const {
    Vector7d x;
    x.head<3>() = VectorFromRotation(other_a_from_b.rotation * a_from_b.rotation.conjugate());
    x[3] = std::log(other_a_from_b.scale / a_from_b.scale);
    x.tail<3>() = (other_a_from_b * anchor_in_b - a_from_b * anchor_in_b) / length_in_a;
    return x;
  }
};

}  // namespace orbweave
