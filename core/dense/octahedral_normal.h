// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace orbweave {

/// A unit vector in four bytes: its projection onto the octahedron |x| + |y| + |z| = 1, whose lower
/// half is folded over the upper. Cigolle et al.: A survey of efficient representations for
/// independent unit vectors, JCGT 2014. Within 0.005 degrees.
struct OctahedralNormal {
  int16_t u = 0;
  int16_t v = 0;
  friend bool operator==(const OctahedralNormal&, const OctahedralNormal&) = default;
};

/// `unit`: finite and not zero.
[[nodiscard]] OctahedralNormal EncodeNormal(const Eigen::Vector3f& unit);
[[nodiscard]] Eigen::Vector3f DecodeNormal(const OctahedralNormal& normal);

}  // namespace orbweave
