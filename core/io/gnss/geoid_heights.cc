// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/gnss/geoid_heights.h"

#include <GeographicLib/Geoid.hpp>
#include <exception>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

/// Names of GeographicLib's grids, the finest first.
std::vector<std::string> GridsOf(HeightDatum datum) {
  if (datum == HeightDatum::kEgm96) return {"egm96-5", "egm96-15"};
  return {"egm2008-1", "egm2008-2_5", "egm2008-5"};
}

}  // namespace

struct GeoidHeights::Grid {
  Grid(const std::string& name, const std::string& folder) : geoid(name, folder) {}
  GeographicLib::Geoid geoid;
};

GeoidHeights::GeoidHeights(std::unique_ptr<Grid> grid) : grid_(std::move(grid)) {}
GeoidHeights::GeoidHeights(GeoidHeights&&) noexcept = default;
GeoidHeights& GeoidHeights::operator=(GeoidHeights&&) noexcept = default;
GeoidHeights::~GeoidHeights() = default;

absl::StatusOr<GeoidHeights> GeoidHeights::Open(HeightDatum datum, const std::string& folder) {
  const std::vector<std::string> names = GridsOf(datum);
  for (const std::string& name : names) {
    try {
      return GeoidHeights(std::make_unique<Grid>(name, folder));
    } catch (const std::exception&) {
      continue;  // not installed: the next one
    }
  }
  return absl::FailedPreconditionError(
      absl::StrCat("ingest.height (--height) needs the geoid grid ",
                   names.back(),
                   " of GeographicLib, which is not in ",
                   folder.empty() ? GeographicLib::Geoid::DefaultGeoidPath() : folder,
                   " on the machine that reads the positions: install geographiclib-tools and run "
                   "'geographiclib-get-geoids ",
                   names.back(),
                   "', or give heights above the ellipsoid"));
}

absl::StatusOr<double> GeoidHeights::EllipsoidalHeight(double latitude_deg,
                                                       double longitude_deg,
                                                       double height_m) const {
  try {
    return grid_->geoid.ConvertHeight(
        latitude_deg, longitude_deg, height_m, GeographicLib::Geoid::GEOIDTOELLIPSOID);
  } catch (const std::exception& error) {
    return absl::FailedPreconditionError(
        absl::StrCat("the geoid grid cannot be read: ", error.what()));
  }
}

}  // namespace orbweave
