// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "core/io/gnss/utm_frame.h"

namespace orbweave {

/// Where a picture from above lies in an east-north-up frame.
struct PicturePlace {
  int width_px = 0;
  int height_px = 0;
  double pixel_m = 0.0;
  Eigen::Vector2d corner_m = Eigen::Vector2d::Zero();  ///< upper left one: east, north
};

/// A world file (.pgw beside .png): the affine map from column and row of pixel middles to easting
/// and northing, six numbers in six lines. It agrees with the zone at three corners of the picture;
/// between them UTM bends by less than a centimetre over a kilometre.
[[nodiscard]] std::string WorldFileText(const PicturePlace& place, const UtmFrame& utm);

/// What GDAL and QGIS read beside a picture as NAME.aux.xml to know its frame.
[[nodiscard]] std::string PictureFrameXml(const UtmFrame& utm);

}  // namespace orbweave
