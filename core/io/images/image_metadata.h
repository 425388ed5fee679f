// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// What the header of an image says, before any pixel is decoded.
struct ImageMetadata {
  int width_px = 0;
  int height_px = 0;
  /// EXIF GPS, WGS84, where latitude and longitude name their hemisphere. Altitude as written
  /// there: above sea level or ellipsoid, cameras differ; 0 unless `altitude_known`.
  std::optional<GeodeticPosition> position{};
  bool altitude_known = false;
  /// GPSAltitudeRef says that the altitude is counted from the ellipsoid (EXIF 3.0).
  bool altitude_of_ellipsoid = false;
  /// Why a position that is written there was left out; empty where nothing was. For whoever read
  /// the header: not passed on.
  std::string position_problem{};
  /// What else is written there and was left out, as it cannot be or is magnetic: its value by its
  /// name ("heading"). Not passed on either.
  std::map<std::string, std::string> left_out{};
  /// EXIF GPSHPositioningError, metres; left out below a millimetre. A position worse than
  /// 10 km is left out itself.
  std::optional<double> position_error_m{};
  /// Direction of the image centre in degrees: XMP-GPano PoseHeadingDegrees, else EXIF
  /// GPSImgDirection (clockwise from north); pitch up positive; roll clockwise positive.
  std::optional<double> heading_deg{};
  std::optional<double> pitch_deg{};
  std::optional<double> roll_deg{};
  /// DateTimeOriginal with SubSec and offset, seconds since 1970; read as UTC where no offset is
  /// given.
  std::optional<double> capture_time_s{};
};

/// Reads the header, EXIF and XMP of an encoded image (JPEG, PNG, TIFF, BMP, WebP, PPM/PGM). Absurd
/// values (latitude beyond 90 degrees, minutes beyond 60, a number over zero) are left out and
/// named, 0/0 in silence. InvalidArgument: no image of a known kind, a header that gives no
/// dimensions, or data that end before the image does ("truncated"). Thread-safe.
[[nodiscard]] absl::StatusOr<ImageMetadata> ReadImageMetadata(std::string_view encoded);

}  // namespace orbweave
