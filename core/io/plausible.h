// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

/// What numbers from outside may be before they are believed at all.

namespace orbweave {

/// Metres above sea level or the ellipsoid. The deepest mines end 4 km below ground, aircraft fly
/// below 20 km; -9999, -32768 and 1e308 stand for "unknown".
[[nodiscard]] inline bool IsPlausibleHeight(double height_m) {
  return height_m >= -5000.0 && height_m <= 20000.0;
}

/// One coordinate of a local or projected frame in metres: map grids reach 1e7, Earth-centred
/// coordinates 6.4e6.
[[nodiscard]] inline bool IsPlausibleCoordinate(double coordinate_m) {
  return std::abs(coordinate_m) <= 1e8;
}

/// A standard deviation of a position in metres: what the option ingest.gnss_sigma_m may be. No
/// receiver on a moving mount is better than a millimetre; what is worse than 10 km is no position.
inline constexpr double kLargestSigma_m = 1e4;
[[nodiscard]] inline bool IsPlausibleSigma(double sigma_m) {
  return sigma_m >= 1e-3 && sigma_m <= kLargestSigma_m;
}

/// A standard deviation of a direction in degrees. Sensors of a surveying car reach 0.005; beyond
/// 180 there is no direction.
[[nodiscard]] inline bool IsPlausibleDirectionSigma(double sigma_deg) {
  return sigma_deg >= 1e-3 && sigma_deg <= 180.0;
}

/// Degrees; a heading may be counted from -180 or from 0.
[[nodiscard]] inline bool IsPlausibleHeading(double heading_deg) {
  return std::abs(heading_deg) <= 360.0;
}
[[nodiscard]] inline bool IsPlausiblePitch(double pitch_deg) { return std::abs(pitch_deg) <= 90.0; }
[[nodiscard]] inline bool IsPlausibleRoll(double roll_deg) { return std::abs(roll_deg) <= 180.0; }

}  // namespace orbweave
