// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "core/geometry/rigid3.h"
#include "core/io/byte_stream.h"

/// What COLMAP's binary files have in common.

namespace orbweave {

/// The count that a file begins with.
inline std::string ColmapCount(uint64_t count) { return ByteWriter().Put(count).Take(); }

/// qw qx qy qz tx ty tz.
inline void PutColmapPose(const Rigid3& pose, ByteWriter& out) {
  const Eigen::Quaterniond& q = pose.rotation;
  const Eigen::Vector3d& t = pose.translation;
  out.Put(q.w()).Put(q.x()).Put(q.y()).Put(q.z()).Put(t.x()).Put(t.y()).Put(t.z());
}

}  // namespace orbweave
