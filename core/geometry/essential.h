// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/geometry/rigid3.h"

namespace orbweave {

/// E = [T]x R with p_b^T E p_a = 0 (6) for bearings of the same point; T as it comes.
[[nodiscard]] Eigen::Matrix3d EssentialFromPose(const Rigid3& b_from_a);

/// The four poses with |T| = 1 that have the essential matrix E up to scale and sign: (R, T), (R,
/// -T), (R', T), (R', -T), R' = R turned by pi about T. Closed form, R = cof(E) - [T]x E for |E| =
/// sqrt(2): Horn, Recovering baseline and orientation from essential matrix, 1990. E of rank two,
/// not zero.
[[nodiscard]] std::array<Rigid3, 4> PosesFromEssential(const Eigen::Matrix3d& E);

/// The nearest matrix (Frobenius) with singular values (1, 1, 0), up to scale.
[[nodiscard]] Eigen::Matrix3d NearestEssential(const Eigen::Matrix3d& M);

}  // namespace orbweave
