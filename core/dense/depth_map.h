// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/dense/octahedral_normal.h"

namespace orbweave {

/// Bits of `DepthMap::flags`.
enum DepthFlag : uint8_t {
  kDepthPriorOnly = 1,  ///< a plane of the surroundings says so, no match of its own does
  kDepthChecked = 2,    ///< maps of other panoramas agree (CheckDepths)
};

/// What a panorama sees, on the equiangular cube of EquiangularRaster: entry
/// (face * face_px + row) * face_px + column of every vector. Empty (face_px = 0) with a reason
/// where nothing could be computed.
struct DepthMap {
  int face_px = 0;
  std::vector<float> range_m{};             ///< distance along the unit bearing; 0: none
  std::vector<OctahedralNormal> normals{};  ///< camera frame, towards the camera
  std::vector<float> sigma_m{};             ///< of the range
  std::vector<uint8_t> views{};             ///< sources that agree
  std::vector<uint8_t> flags{};             ///< DepthFlag
  std::string problem{};                    ///< why it is empty, for people; empty when all is well

  [[nodiscard]] size_t size() const { return range_m.size(); }
};

}  // namespace orbweave
