// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace orbweave {

[[nodiscard]] constexpr int Modulo(int value, int n) { return ((value % n) + n) % n; }

/// The row of a panorama that continues it beyond a pole, and whether it lies half a turn away.
struct SourceRow {
  int row = 0;
  bool turned = false;
};

/// Row -1 - j is row j, half a turn away; row height + j is row height - 1 - j. Any number of times
/// round the sphere.
[[nodiscard]] constexpr SourceRow RowAcrossPoles(int row, int height) {
  const int folded = Modulo(row, 2 * height);  // once round the sphere, through both poles
  return folded < height ? SourceRow{folded, false} : SourceRow{2 * height - 1 - folded, true};
}

}  // namespace orbweave
