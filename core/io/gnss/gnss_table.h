// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/io/gnss/gnss_fix.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// One usable row: where an image was taken, and how it was turned. A position without a fix, or
/// worse than 10 km, is left out of it.
struct GnssRow {
  std::string name{};  ///< of the image, as written
  int line = 0;        ///< in the file, from 1
  std::optional<GeodeticPosition> geodetic{};
  bool altitude_known = false;                         ///< of `geodetic`
  std::optional<Eigen::Vector3d> position_in_local{};  ///< metres, x east or free, z up
  std::optional<double> accuracy_m{};                  ///< horizontal standard deviation
  std::optional<double> vertical_accuracy_m{};         ///< standard deviation
  std::optional<GnssFix> fix{};
  std::optional<double> heading_deg{};
  std::optional<double> pitch_deg{};
  std::optional<double> roll_deg{};
  std::optional<double> heading_sigma_deg{};  ///< standard deviation
  std::optional<double> tilt_sigma_deg{};     ///< of pitch and roll, the larger of both
  std::optional<double> capture_time_s{};
  std::optional<std::string> drive{};
};

/// Rows in file order; either all positions are geodetic or all are local.
struct GnssTable {
  std::vector<GnssRow> rows{};
  /// Cells that are not used though their rows are, one line for each kind.
  std::vector<std::string> warnings{};
  /// Rows that are not used, each with its reason: "gnss.csv line 17 (img.jpg)".
  std::vector<Exclusion> rejected{};
};

/// Reads a table of image positions, one of
///  - CSV (comma, semicolon or tab) with a header, columns in any order and case, others ignored:
///    name,latitude,longitude or name,x,y,z (local metres), and any of altitude, accuracy,
///    vertical_accuracy (metres), fix (GnssFixFromText), time (TimeFromText; numbers that can only
///    be milli-, micro- or nanoseconds since 1970 are taken as such), drive, heading, pitch, roll,
///    heading_accuracy, pitch_accuracy, roll_accuracy (degrees); ExifTool's names (SourceFile,
///    GPSLatitude, ..., PoseHeadingDegrees) are understood. Accuracies are standard deviations;
///    0 and less stand for none;
///  - SphereSfM's POS.txt: first line "#F=N X Y Z ...", then one image per line; X is longitude or
///    easting, Y latitude or northing. Degrees when all values can be such and span less than 2
///    degrees away from (0, 0); metres otherwise. Rotations there are of no stated frame and are
///    not read.
/// `source` names the table in messages. A row that cannot be read, has more cells than the header,
/// names an image again, or has an absurd position (|latitude| > 90, |longitude| > 180, not a
/// number, exactly 0/0) goes to `rejected`. A cell that cannot be (plausible.h), or a position
/// that is worse than 10 km or whose fix type is none, is left out with a warning. InvalidArgument:
/// no header or a needed column is missing, no usable row, decimal commas, or latitude and
/// longitude are swapped (at least half of the rows fit only the other way round).
[[nodiscard]] absl::StatusOr<GnssTable> ParseGnssTable(std::string_view text,
                                                       std::string_view source);

}  // namespace orbweave
