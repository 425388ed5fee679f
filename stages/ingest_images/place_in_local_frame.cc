// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/place_in_local_frame.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/quantile.h"
#include "core/scene/local_frame.h"

namespace orbweave {
namespace {

constexpr double kFarthestFromMedianM = 1e6;
// Coarse, so that the frame does not move with the noise of the positions.
constexpr double kOriginStepDeg = 1e-3;  ///< about 100 m
constexpr double kOriginStepM = 10.0;

double Median(std::vector<double> values) {
  return values.empty() ? 0.0 : UpperMedian(std::move(values));
}

/// Degrees in (-180, 180].
double WrappedDegrees(double degrees) {
  return degrees - 360.0 * std::ceil((degrees - 180.0) / 360.0);
}

/// The rounded median of all positions; longitudes are taken about the first, so the date line is
/// nowhere special.
std::optional<GeodeticPosition> OriginOf(const std::vector<ImageRecord>& images) {
  std::vector<double> latitudes;
  std::vector<double> longitudes;
  std::vector<double> altitudes;
  double reference_deg = 0.0;
  for (const ImageRecord& image : images) {
    if (!image.prior.geodetic) continue;
    const GeodeticPosition& position = *image.prior.geodetic;
    if (latitudes.empty()) reference_deg = position.longitude_deg;
    latitudes.push_back(position.latitude_deg);
    longitudes.push_back(WrappedDegrees(position.longitude_deg - reference_deg));
    if (std::isfinite(position.altitude_m)) altitudes.push_back(position.altitude_m);
  }
  if (latitudes.empty()) return std::nullopt;
  const auto rounded = [](double degrees) {
    return std::round(degrees / kOriginStepDeg) * kOriginStepDeg;
  };
  return GeodeticPosition{rounded(Median(latitudes)),
                          rounded(WrappedDegrees(Median(longitudes) + reference_deg)),
                          std::round(Median(altitudes) / kOriginStepM) * kOriginStepM};
}

}  // namespace

void PlaceInLocalFrame(ImageManifest& manifest) {
  manifest.origin = OriginOf(manifest.images);
  if (!manifest.origin) return;
  for (ImageRecord& image : manifest.images) {
    std::optional<GeodeticPosition>& position = image.prior.geodetic;
    if (!position) continue;
    if (!std::isfinite(position->altitude_m)) position->altitude_m = manifest.origin->altitude_m;
    const Eigen::Vector3d point_in_enu = EnuFromGeodetic(*position, *manifest.origin);
    if (point_in_enu.norm() <= kFarthestFromMedianM) {
      image.prior.position_in_enu = point_in_enu;
      continue;
    }
    manifest.warnings.push_back(absl::StrCat("the position of ",
                                             image.name,
                                             " is ",
                                             std::round(point_in_enu.norm() / 1000.0),
                                             " km from the middle of all others; it is not used"));
    position.reset();
  }
}

}  // namespace orbweave
