// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/place_picture.h"

#include <gtest/gtest.h>

#include <sstream>

namespace orbweave {
namespace {

TEST(WorldFile, PutsEveryPixelWhereTheZoneHasItToACentimetre) {
  const UtmFrame utm({48.9, 11.9, 300.0});  // where UTM bends most: near the edge of its zone
  const PicturePlace place{
      .width_px = 2000, .height_px = 2000, .pixel_m = 0.5, .corner_m = {-400.0, 700.0}};
  double a = 0, d = 0, b = 0, e = 0, c = 0, f = 0;
  std::istringstream(WorldFileText(place, utm)) >> a >> d >> b >> e >> c >> f;
  for (const auto& [column, row] :
       {std::pair{0, 0}, {1999, 0}, {0, 1999}, {1234, 567}, {1999, 1999}}) {
    const Eigen::Vector3d enu(-400.0 + 0.5 * (column + 0.5), 700.0 - 0.5 * (row + 0.5), 0.0);
    const Eigen::Vector3d wanted = utm.FromEnu(enu);
    EXPECT_NEAR(a * column + b * row + c, wanted.x(), 1e-2);
    EXPECT_NEAR(d * column + e * row + f, wanted.y(), 1e-2);
  }
}

TEST(PictureFrame, NamesTheZone) {
  const std::string xml = PictureFrameXml(UtmFrame({48.9, 9.2, 300.0}));
  EXPECT_NE(xml.find("UTM zone 32N"), std::string::npos);
  EXPECT_EQ(xml.find("[\""), std::string::npos);  // quotes are escaped
}

}  // namespace
}  // namespace orbweave
