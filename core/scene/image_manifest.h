// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/digest.h"
#include "core/geometry/equirectangular_camera.h"
#include "core/scene/ids.h"

namespace orbweave {

/// WGS84 latitude and longitude in degrees, height above the ellipsoid in metres.
struct GeodeticPosition {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;
};

/// Stands for the standard deviation of a height that nobody knows: no measurement of anything.
inline constexpr double kUnknownHeightSigma_m = 1e5;
[[nodiscard]] inline bool IsHeightKnown(double vertical_sigma_m) {
  return vertical_sigma_m < kUnknownHeightSigma_m;
}

/// What is known of a camera before looking at pixels. All of it may be wrong: priors are robust
/// terms, never constraints.
struct PosePrior {
  std::optional<GeodeticPosition> geodetic{};
  /// Camera centre in the job's local frame (east, north, up; metres), present when `geodetic` is.
  /// A database without latitude and longitude may give it directly.
  std::optional<Eigen::Vector3d> position_in_enu{};
  /// Stated or assumed standard deviation of the position. Of a height that nobody knows it is
  /// kUnknownHeightSigma_m, and the height that of the frame's origin.
  double horizontal_sigma_m = 5.0;
  double vertical_sigma_m = 10.0;
  /// Direction of the image centre, clockwise from north; pitch up positive; roll clockwise
  /// positive.
  std::optional<double> heading_deg{};
  std::optional<double> pitch_deg{};
  std::optional<double> roll_deg{};
  /// Standard deviations of `heading_deg`, and of `pitch_deg` and `roll_deg` each, stated or
  /// assumed. The defaults are what a magnetic compass in a car and an uncalibrated inertial sensor
  /// are good for.
  double heading_sigma_deg = 10.0;
  double tilt_sigma_deg = 3.0;
};

/// One panorama that takes part in the job.
struct ImageRecord {
  ImageId id{};
  std::string name{};  ///< path relative to the image folder, '/' as separator
  Digest content{};    ///< blob of the encoded image; zero when the job starts from a database
  Digest mask{};       ///< blob of the encoded mask; zero when there is none
  EquirectangularCamera camera{};
  PosePrior prior{};
  std::optional<double> capture_time_s{};  ///< seconds since 1970, when known
  /// Images of one drive share a number; GNSS biases are per drive.
  uint32_t drive = 0;
};

/// A file, image, row or mask that takes no part, and why: nothing disappears silently.
struct Exclusion {
  std::string name{};
  std::string reason{};
};

/// The job's images in id order, what was left out, and the local frame.
struct ImageManifest {
  std::vector<ImageRecord> images{};         ///< images[i].id.value == i
  std::vector<Exclusion> excluded{};         ///< images that take no part
  std::vector<std::string> warnings{};       ///< e.g. GNSS rows without an image
  std::optional<GeodeticPosition> origin{};  ///< of the east-north-up frame; absent without GNSS
  bool mask_ignores_white = true;

  [[nodiscard]] const ImageRecord& At(ImageId id) const { return images[id.value]; }
};

}  // namespace orbweave
