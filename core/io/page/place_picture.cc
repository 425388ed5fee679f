// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/page/place_picture.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/io/page/html_text.h"

namespace orbweave {

std::string WorldFileText(const PicturePlace& place, const UtmFrame& utm) {
  const auto at = [&](double column, double row) -> Eigen::Vector2d {
    const Eigen::Vector3d enu(
        place.corner_m.x() + column * place.pixel_m, place.corner_m.y() - row * place.pixel_m, 0.0);
    return utm.FromEnu(enu).head<2>();
  };
  const Eigen::Vector2d corner = at(0.0, 0.0);
  const Eigen::Vector2d per_column = (at(place.width_px, 0.0) - corner) / place.width_px;
  const Eigen::Vector2d per_row = (at(0.0, place.height_px) - corner) / place.height_px;
  const Eigen::Vector2d first = corner + 0.5 * (per_column + per_row);
  std::string text;
  for (const Eigen::Vector2d& pair : {per_column, per_row, first})
    absl::StrAppendFormat(&text, "%.12f\n%.12f\n", pair.x(), pair.y());
  return text;
}

std::string PictureFrameXml(const UtmFrame& utm) {
  return absl::StrCat("<PAMDataset>\n  <SRS>", EscapeHtml(utm.Wkt()), "</SRS>\n</PAMDataset>\n");
}

}  // namespace orbweave
