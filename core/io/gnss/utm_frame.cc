// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/gnss/utm_frame.h"

#include <Eigen/Geometry>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/scene/local_frame.h"

namespace orbweave {

UtmFrame::UtmFrame(const GeodeticPosition& origin) : origin_(origin) {
  double easting = 0.0;
  double northing = 0.0;
  double convergence_deg = 0.0;
  double scale = 1.0;
  GeographicLib::UTMUPS::Forward(origin.latitude_deg,
                                 origin.longitude_deg,
                                 zone_,
                                 is_north_,
                                 easting,
                                 northing,
                                 convergence_deg,
                                 scale);
  convergence_rad_ = convergence_deg * std::numbers::pi / 180.0;
}

Eigen::Vector3d UtmFrame::FromGeodetic(const GeodeticPosition& position) const {
  double easting = 0.0;
  double northing = 0.0;
  int zone = 0;
  bool is_north = true;
  GeographicLib::UTMUPS::Forward(
      position.latitude_deg, position.longitude_deg, zone, is_north, easting, northing, zone_);
  if (is_north != is_north_)  // a street across the equator stays in one frame
    northing += (is_north_ ? -1.0 : 1.0) * GeographicLib::UTMUPS::UTMShift();
  return {easting, northing, position.altitude_m};
}

Eigen::Vector3d UtmFrame::Origin() const { return FromGeodetic(origin_).array().round(); }

std::string UtmFrame::Wkt() const {
  if (zone_ == GeographicLib::UTMUPS::UPS) return "";
  const int meridian_deg = 6 * zone_ - 183;
  return absl::StrCat(
      "PROJCS[\"WGS 84 / UTM zone ",
      zone_,
      is_north_ ? "N" : "S",
      "\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563,"
      "AUTHORITY[\"EPSG\",\"7030\"]],AUTHORITY[\"EPSG\",\"6326\"]],PRIMEM[\"Greenwich\",0,"
      "AUTHORITY[\"EPSG\",\"8901\"]],UNIT[\"degree\",0.0174532925199433,"
      "AUTHORITY[\"EPSG\",\"9122\"]],AUTHORITY[\"EPSG\",\"4326\"]],"
      "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
      "PARAMETER[\"central_meridian\",",
      meridian_deg,
      "],PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],"
      "PARAMETER[\"false_northing\",",
      is_north_ ? 0 : 10000000,
      "],UNIT[\"metre\",1,AUTHORITY[\"EPSG\",\"9001\"]],AXIS[\"Easting\",EAST],"
      "AXIS[\"Northing\",NORTH],AUTHORITY[\"EPSG\",\"",
      (is_north_ ? 32600 : 32700) + zone_,
      "\"]]");
}

Eigen::Vector3d UtmFrame::FromEnu(const Eigen::Vector3d& position) const {
  return FromGeodetic(GeodeticFromEnu(position, origin_));
}

std::vector<SurfacePoint> UtmFrame::FromEnu(std::span<const SurfacePoint> points) const {
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(static_cast<float>(convergence_rad_), Eigen::Vector3f::UnitZ())
          .toRotationMatrix();
  std::vector<SurfacePoint> converted(points.begin(), points.end());
  for (SurfacePoint& point : converted) {
    point.position_in_world = FromEnu(point.position_in_world);
    point.normal_in_world = turn * point.normal_in_world;
  }
  return converted;
}

}  // namespace orbweave
