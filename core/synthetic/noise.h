// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace orbweave {

/// A hash of three integers: the random number of a lattice node, brick, window, ...
inline uint32_t HashOf(int32_t i, int32_t j, uint32_t seed) {
  uint32_t h = static_cast<uint32_t>(i) * 0x8da6b343U ^ static_cast<uint32_t>(j) * 0xd8163841U ^
               seed * 0xcb1ab31fU;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  return h ^ (h >> 15);
}

/// The same as a number in [0, 1).
inline double UniformOf(int32_t i, int32_t j, uint32_t seed) {
  return HashOf(i, j, seed) * 0x1.0p-32;
}

/// Smooth random function of the plane in [-1, 1] (value noise; second derivatives are continuous)
/// with independent values at the integer nodes.
[[nodiscard]] double ValueNoise(double u, double v, uint32_t seed);

/// Octaves of value noise from wavelength `longest_m` down by halves to `shortest_m`, equal in
/// amplitude, so that detail exists at every scale. What a pixel of size `footprint_m` could only
/// alias is faded out. About [-1, 1]; the standard deviation is near 0.3 when nothing is faded.
struct NoiseBand {
  double longest_m = 4.0;
  double shortest_m = 0.02;
};
[[nodiscard]] double FractalNoise(
    double u, double v, const NoiseBand& band, double footprint_m, uint32_t seed);

}  // namespace orbweave
