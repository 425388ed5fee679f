// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace orbweave {

/// What a cell of a GNSS table means.
enum GnssColumn {
  kName,
  kLatitude,
  kLongitude,
  kAltitude,
  kX,
  kY,
  kZ,
  kAccuracy,
  kHeading,
  kPitch,
  kRoll,
  kTime,
  kDrive,
  kVerticalAccuracy,
  kFix,
  kHeadingAccuracy,
  kPitchAccuracy,
  kRollAccuracy,
  kNumGnssColumns
};

/// A row cut into cells, as text: `cells[column]` is empty where the table has no such column.
struct GnssCells {
  int line = 0;  ///< in the file, from 1
  /// Why nothing in it can be trusted: it has more cells than the header. Empty otherwise.
  std::string problem{};
  std::array<std::string, kNumGnssColumns> cells{};
};

/// Cuts a table into rows of cells: CSV with a header of known names, or POS.txt (see
/// gnss_table.h). InvalidArgument: the table is empty, its first line does not name the needed
/// columns, or its numbers have decimal commas.
[[nodiscard]] absl::StatusOr<std::vector<GnssCells>> ReadGnssCells(std::string_view text,
                                                                   std::string_view source);

}  // namespace orbweave
