// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/trajectory_geojson.h"

#include <cmath>
#include <utility>

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

Json Geometry(const char* type, Json coordinates) {
  return {{"type", type}, {"coordinates", std::move(coordinates)}};
}

Json Feature(Json geometry, Json properties) {
  return {{"type", "Feature"},
          {"geometry", std::move(geometry)},
          {"properties", std::move(properties)}};
}

/// Why it has no place on earth of its own; empty where it has.
std::string ReasonOf(const JobReport& report, const ReportImage& image) {
  if (!image.registered || image.loose || report.IsGeoreferenced(image)) return image.reason;
  const bool is_known = image.model < report.each_model.size();
  const std::string why = is_known ? report.each_model[image.model].gnss.reason : "";
  return "its model is not georeferenced" + (why.empty() ? "" : ": " + why);
}

Json PropertiesOf(const JobReport& report, const ReportImage& image) {
  Json properties = {{"name", image.name}, {"state", image.StateText()}, {"drive", image.drive}};
  if (image.cluster >= 0) properties["cluster"] = image.cluster;
  if (const std::string reason = ReasonOf(report, image); !reason.empty())
    properties["reason"] = reason;
  if (!image.registered) return properties;
  properties["model"] = image.model;
  properties["loose"] = image.loose;
  properties["observations"] = image.observations;
  if (image.observations > 0) properties["residual_px"] = Rounded(image.residual_px_mean, 1e-4);
  if (!image.uncertainty || !report.IsGeoreferenced(image)) return properties;
  const Eigen::Vector3d sigmas_m = image.uncertainty->PositionSigmas();
  properties["sigma_east_m"] = Rounded(sigmas_m.x(), 1e-6);
  properties["sigma_north_m"] = Rounded(sigmas_m.y(), 1e-6);
  properties["sigma_up_m"] = Rounded(sigmas_m.z(), 1e-6);
  properties["sigma_rotation_deg"] = Rounded(image.uncertainty->RotationSigma_deg(), 1e-7);
  return properties;
}

Json LineOf(const ReportPath& path, const JobReport& report) {
  Json positions = Json::array();
  for (const uint32_t image : path.images)
    positions.push_back(PositionOf(report.images[image].cam_from_world, *report.origin));
  return Feature(Geometry("LineString", std::move(positions)),
                 {{"model", path.model}, {"drive", path.drive}});
}

}  // namespace

absl::StatusOr<std::string> TrajectoryGeoJson(const JobReport& report) {
  if (!report.origin) return absl::FailedPreconditionError("the job has no latitude and longitude");
  Json features = Json::array();
  for (const ReportPath& path : report.paths) {
    if (report.IsGeoreferenced(report.images[path.images.front()]))
      features.push_back(LineOf(path, report));
  }
  for (const ReportImage& image : report.images) {
    Json geometry = nullptr;
    if (report.IsGeoreferenced(image))
      geometry = Geometry("Point", PositionOf(image.cam_from_world, *report.origin));
    features.push_back(Feature(std::move(geometry), PropertiesOf(report, image)));
  }
  return JsonText({{"type", "FeatureCollection"}, {"features", std::move(features)}});
}

}  // namespace orbweave
