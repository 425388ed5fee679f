// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace orbweave {

/// Pixels that are matched side by side: every other one of a row of the reference raster.
inline constexpr size_t kMatchLanes = 16;
/// A patch: 6 x 6 taps, two pixels apart, about its middle pixel (11 x 11 pixels).
inline constexpr int kPatchRadius_px = 5;
inline constexpr size_t kTapPairs = 18;

using LaneFloats = std::array<float, kMatchLanes>;
using LaneInts = std::array<int32_t, kMatchLanes>;

/// The patches of kMatchLanes pixels and their rays, in the frame of the reference's face. Taps go
/// in pairs, neighbours of a row, as two 16-bit numbers of a lane.
struct alignas(64) ReferencePatches {
  std::array<LaneInts, kTapPairs> weights{};   ///< bilateral, 0 ... 64
  std::array<LaneInts, kTapPairs> weighted{};  ///< weight x grey level
  LaneFloats weight_sum{};
  LaneFloats mean{};     ///< weighted mean grey level
  LaneFloats scatter{};  ///< sum of w (level - mean)^2
  /// Rays r0 = (x, y, 1), their derivatives by a column a = (dx, 0, 0) and by a row b = (0, dy, 0).
  LaneFloats x{};
  LaneFloats dx{};
  float y = 0.0F;
  float dy = 0.0F;
};

/// Where a source's faces are and how they lie to the reference's face.
struct MatchView {
  std::array<float, 9> rotation{};  ///< source_from_face, row-major
  std::array<float, 3> translation{};
  const uint32_t* quads = nullptr;  ///< SourceFaces
  int size_px = 0;
  float focal_px = 0.0F;
  const uint8_t* ignored = nullptr;  ///< SourceFaces::ignored, or none
  int tiles = 0;
};

/// Planes q.x = 1 in the frame of the reference's face, one for each lane.
struct alignas(64) PlaneLanes {
  LaneFloats x{};
  LaneFloats y{};
  LaneFloats z{};
};

inline constexpr float kNoMatch = -2.0F;  ///< correlation where there is nothing to compare

}  // namespace orbweave
