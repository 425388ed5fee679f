// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "tests/core/io/io_test_support.h"

namespace orbweave {

/// A grid of GeographicLib's format that is `height_m` (a multiple of a quarter of a metre) above
/// the ellipsoid everywhere: 16-bit samples every 30 degrees, offset and scale as comments.
inline std::string GeoidGrid(double height_m) {
  constexpr int kColumns = 12;
  constexpr int kRows = 7;
  std::string grid =
      "P5\n# Offset -108\n# Scale 0.25\n# Origin 90N 0E\n# Description made up\n"
      "# DateTime 2020-01-01 00:00:00\n# MaxBilinearError 0\n# RMSBilinearError 0\n"
      "# MaxCubicError 0\n# RMSCubicError 0\n# AREA_OR_POINT Point\n"
      "# Vertical_Datum WGS84\n" +
      std::to_string(kColumns) + " " + std::to_string(kRows) + "\n65535\n";
  const auto sample = static_cast<int>(std::lround((height_m + 108.0) / 0.25));
  for (int i = 0; i < kColumns * kRows; ++i) {
    grid += static_cast<char>(sample >> 8);
    grid += static_cast<char>(sample & 0xff);
  }
  return grid;
}

}  // namespace orbweave
