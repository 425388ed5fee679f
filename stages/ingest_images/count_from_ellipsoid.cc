// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/count_from_ellipsoid.h"

#include <cmath>

#include "core/base/status.h"

namespace orbweave {

absl::Status CountFromEllipsoid(HeightDatum datum,
                                const std::set<ImageId>& of_ellipsoid,
                                ImageManifest& manifest,
                                const std::string& folder) {
  if (datum == HeightDatum::kEllipsoid) return absl::OkStatus();
  ORBWEAVE_ASSIGN_OR_RETURN(const GeoidHeights geoid, GeoidHeights::Open(datum, folder));
  size_t count = 0;
  for (ImageRecord& image : manifest.images) {
    if (!image.prior.geodetic || !std::isfinite(image.prior.geodetic->altitude_m)) continue;
    if (of_ellipsoid.contains(image.id)) continue;
    GeodeticPosition& position = *image.prior.geodetic;
    ORBWEAVE_ASSIGN_OR_RETURN(
        position.altitude_m,
        geoid.EllipsoidalHeight(
            position.latitude_deg, position.longitude_deg, position.altitude_m));
    ++count;
  }
  if (count == 0) {
    manifest.warnings.emplace_back(
        "ingest.height (--height) changes nothing: no position has latitude, longitude and "
        "an altitude that may be counted from a geoid");
  }
  return absl::OkStatus();
}

}  // namespace orbweave
