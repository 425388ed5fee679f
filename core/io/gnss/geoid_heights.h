// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// What heights are counted from: the ellipsoid of WGS84, or the sea as a geoid model has it.
enum class HeightDatum { kEllipsoid, kEgm96, kEgm2008 };

/// Heights of a geoid above the ellipsoid, from GeographicLib's grids.
class GeoidHeights {
 public:
  /// Opens the finest grid of `datum`, which is a geoid, in `folder`, or where GeographicLib looks
  /// when `folder` is empty (GEOGRAPHICLIB_GEOID_PATH, else /usr/share/GeographicLib/geoids or the
  /// like). FailedPrecondition, with what to install, where there is none.
  [[nodiscard]] static absl::StatusOr<GeoidHeights> Open(HeightDatum datum,
                                                         const std::string& folder = "");
  GeoidHeights(GeoidHeights&&) noexcept;
  GeoidHeights& operator=(GeoidHeights&&) noexcept;
  ~GeoidHeights();

  /// h = H + N: metres above the ellipsoid of a point `height_m` above the geoid.
  /// FailedPrecondition when the grid's file cannot be read.
  [[nodiscard]] absl::StatusOr<double> EllipsoidalHeight(double latitude_deg,
                                                         double longitude_deg,
                                                         double height_m) const;

 private:
  struct Grid;
  explicit GeoidHeights(std::unique_ptr<Grid> grid);
  std::unique_ptr<Grid> grid_;
};

}  // namespace orbweave
