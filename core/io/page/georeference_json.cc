// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/georeference_json.h"

#include <GeographicLib/Geocentric.hpp>

#include "core/io/json_text.h"

namespace orbweave {
namespace {

/// Rows of the 4x4 matrix ecef_from_enu.
Json EcefFromEnu(const GeodeticPosition& origin) {
  std::vector<double> R(9);  // rows: x, y, z; columns: east, north, up
  double t[3];
  GeographicLib::Geocentric::WGS84().Forward(
      origin.latitude_deg, origin.longitude_deg, origin.altitude_m, t[0], t[1], t[2], R);
  Json rows = Json::array();
  for (size_t i = 0; i < 3; ++i) rows.push_back({R[3 * i], R[3 * i + 1], R[3 * i + 2], t[i]});
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

}  // namespace

std::string GeoreferenceJson(const ImageManifest& manifest, const std::vector<uint32_t>& models) {
  const bool georeferenced = !models.empty();
  Json json;
  json["georeferenced"] = georeferenced && manifest.origin.has_value();
  if (!georeferenced || !manifest.origin) {
    json["axes"] = "free";
    json["unit"] = georeferenced ? "metre" : "free";
    return JsonText(json);
  }
  json["datum"] = "WGS84";
  json["origin"] = {{"latitude", manifest.origin->latitude_deg},
                    {"longitude", manifest.origin->longitude_deg},
                    {"altitude", manifest.origin->altitude_m}};
  json["axes"] = "east-north-up";
  json["unit"] = "metre";
  json["ecef_from_enu"] = EcefFromEnu(*manifest.origin);
  json["models"] = models;
  return JsonText(json);
}

}  // namespace orbweave
