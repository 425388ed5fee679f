// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/local_frame.h"

#include <GeographicLib/LocalCartesian.hpp>

namespace orbweave {
namespace {

GeographicLib::LocalCartesian FrameAt(const GeodeticPosition& origin) {
  return {origin.latitude_deg, origin.longitude_deg, origin.altitude_m};
}

}  // namespace

Eigen::Vector3d EnuFromGeodetic(const GeodeticPosition& position, const GeodeticPosition& origin) {
  Eigen::Vector3d enu;
  FrameAt(origin).Forward(position.latitude_deg,
                          position.longitude_deg,
                          position.altitude_m,
                          enu.x(),
                          enu.y(),
                          enu.z());
  return enu;
}

GeodeticPosition GeodeticFromEnu(const Eigen::Vector3d& point_in_enu,
                                 const GeodeticPosition& origin) {
  GeodeticPosition position;
  FrameAt(origin).Reverse(point_in_enu.x(),
                          point_in_enu.y(),
                          point_in_enu.z(),
                          position.latitude_deg,
                          position.longitude_deg,
                          position.altitude_m);
  return position;
}

}  // namespace orbweave
