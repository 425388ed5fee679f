// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/trajectory_geojson.h"

#include <cmath>
#include <map>

#include "core/io/json_text.h"
#include "core/scene/local_frame.h"

namespace orbweave {
namespace {

double Rounded(double value, double step) { return std::round(value / step) * step; }

/// [longitude, latitude, altitude] to a tenth of a millimetre or so: RFC 7946, 3.1.1.
Json PositionOf(const Rigid3& cam_from_world, const GeodeticPosition& origin) {
  const GeodeticPosition position = GeodeticFromEnu(cam_from_world.Centre(), origin);
  return Json::array({Rounded(position.longitude_deg, 1e-9),
                      Rounded(position.latitude_deg, 1e-9),
                      Rounded(position.altitude_m, 1e-4)});
}

Json Feature(const char* type, Json coordinates, Json properties) {
  return {{"type", "Feature"},
          {"geometry", {{"type", type}, {"coordinates", std::move(coordinates)}}},
          {"properties", std::move(properties)}};
}

Json PropertiesOf(const ImageRecord& record, const RegisteredImage& image) {
  Json properties = {{"name", record.name}, {"drive", record.drive}, {"loose", image.loose}};
  if (!image.uncertainty) return properties;
  const Eigen::Vector3d sigmas_m = image.uncertainty->PositionSigmas();
  properties["sigma_east_m"] = Rounded(sigmas_m.x(), 1e-6);
  properties["sigma_north_m"] = Rounded(sigmas_m.y(), 1e-6);
  properties["sigma_up_m"] = Rounded(sigmas_m.z(), 1e-6);
  properties["sigma_rotation_deg"] = Rounded(image.uncertainty->RotationSigma_deg(), 1e-7);
  return properties;
}

}  // namespace

absl::StatusOr<std::string> TrajectoryGeoJson(const std::map<ImageId, RegisteredImage>& images,
                                              const ImageManifest& manifest) {
  if (!manifest.origin)
    return absl::FailedPreconditionError("the job has no latitude and longitude");
  std::map<uint32_t, Json> line_of_drive;
  Json points = Json::array();
  for (const auto& [id, image] : images) {
    const ImageRecord& record = manifest.At(id);
    Json position = PositionOf(image.cam_from_world, *manifest.origin);
    line_of_drive[record.drive].push_back(position);
    points.push_back(Feature("Point", std::move(position), PropertiesOf(record, image)));
  }
  Json features = Json::array();
  for (auto& [drive, line] : line_of_drive) {
    if (line.size() < 2) continue;  // a LineString has two positions at least
    features.push_back(Feature("LineString", std::move(line), {{"drive", drive}}));
  }
  for (Json& point : points) features.push_back(std::move(point));
  return JsonText({{"type", "FeatureCollection"}, {"features", std::move(features)}});
}

}  // namespace orbweave
