// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace orbweave {

/// How a receiver came by a position.
enum class GnssFix {
  kNone,  ///< no position, or none that was measured (dead reckoning, typed in, simulated)
  kAutonomous,
  kDifferential,  ///< corrections to code ranges: DGPS, SBAS
  kRtkFloat,
  kRtkFixed,
};

/// The fix type of a cell: a word ("RTK fixed", "float", "DGPS", "autonomous", "3D", "no fix", ...,
/// in any case, with blanks, '_' or '-' between) or the number of an NMEA GGA sentence (0 none, 1
/// autonomous, 2 differential, 3 PPS, 4 RTK fixed, 5 RTK float, 6 dead reckoning, 7 manual, 8
/// simulated). Nullopt for anything else.
[[nodiscard]] std::optional<GnssFix> GnssFixFromText(std::string_view text);

/// The horizontal standard deviation to expect of a fix whose receiver states none, in metres;
/// nullopt where the job's default for positions (ingest.gnss_sigma_m) is to stand.
[[nodiscard]] std::optional<double> SigmaOfFix(GnssFix fix);

}  // namespace orbweave
