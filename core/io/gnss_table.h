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
#include "core/scene/image_manifest.h"

namespace orbweave {

/// One usable row: where an image was taken, and how it was turned.
struct GnssRow {
  std::string name{};  ///< of the image, as written
  int line = 0;        ///< in the file, from 1
  std::optional<GeodeticPosition> geodetic{};
  bool altitude_known = false;                         ///< of `geodetic`
  std::optional<Eigen::Vector3d> position_in_local{};  ///< metres, x east or free, z up
  std::optional<double> accuracy_m{};                  ///< horizontal standard deviation
  std::optional<double> heading_deg{};
  std::optional<double> pitch_deg{};
  std::optional<double> roll_deg{};
  std::optional<double> capture_time_s{};
  std::optional<std::string> drive{};
};

/// Rows in file order; either all are geodetic or all are local.
struct GnssTable {
  std::vector<GnssRow> rows{};
  /// Rows that are not used, each with its reason: "gnss.csv line 17 (img.jpg)".
  std::vector<Exclusion> rejected{};
};

/// Reads a table of image positions, one of
///  - CSV (comma, semicolon or tab) with a header, columns in any order and case, others ignored:
///    name,latitude,longitude[,altitude,accuracy,heading,pitch,roll,time,drive] or name,x,y,z[,...]
///    (local metres); ExifTool's names (SourceFile, GPSLatitude, ..., PoseHeadingDegrees) are
///    understood;
///  - SphereSfM's POS.txt: first line "#F=N X Y Z ...", then one image per line; X is longitude or
///    easting, Y latitude or northing. Degrees when all values can be such and span less than 2
///    degrees away from (0, 0); metres otherwise. Rotations there are of no stated frame and are
///    not read.
/// `source` names the table in messages. A row that cannot be read, names an image again, or has an
/// absurd position (|latitude| > 90, |longitude| > 180, not a number, exactly 0/0) goes to
/// `rejected`. InvalidArgument: no header or a needed column is missing, no usable row, or latitude
/// and longitude are swapped (at least half of the rows fit only the other way round).
[[nodiscard]] absl::StatusOr<GnssTable> ParseGnssTable(std::string_view text,
                                                       std::string_view source);

}  // namespace orbweave
