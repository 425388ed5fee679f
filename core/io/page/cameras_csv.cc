// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/cameras_csv.h"

#include <charconv>

#include "core/io/text_fields.h"
#include "core/scene/local_frame.h"

namespace orbweave {
namespace {

/// "," and `value` with `digits` after the point.
void AppendNumber(std::string& line, double value, int digits) {
  char buffer[400];
  const auto end =
      std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::fixed, digits).ptr;
  line += ',';
  line.append(buffer, end);
}

void AppendPose(std::string& line, const Rigid3& cam_from_world) {
  const Eigen::Vector3d centre_in_world = cam_from_world.Centre();
  for (int axis = 0; axis < 3; ++axis) AppendNumber(line, centre_in_world[axis], 6);
  Eigen::Quaterniond q = cam_from_world.rotation;
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  for (const double component : {q.w(), q.x(), q.y(), q.z()}) AppendNumber(line, component, 12);
}

void AppendGeodetic(std::string& line,
                    const Rigid3& cam_from_world,
                    const GeodeticPosition& origin) {
  const GeodeticPosition position = GeodeticFromEnu(cam_from_world.Centre(), origin);
  AppendNumber(line, position.latitude_deg, 9);
  AppendNumber(line, position.longitude_deg, 9);
  AppendNumber(line, position.altitude_m, 4);
}

void AppendUncertainty(std::string& line, const std::optional<PoseUncertainty>& uncertainty) {
  if (!uncertainty) {
    line += ",,,,";
    return;
  }
  const Eigen::Vector3d sigmas = uncertainty->PositionSigmas();
  for (int axis = 0; axis < 3; ++axis) AppendNumber(line, sigmas[axis], 6);
  AppendNumber(line, uncertainty->RotationSigma_deg(), 7);
}

constexpr const char* kPoseHeader =
    "name,x,y,z,qw,qx,qy,qz,latitude,longitude,altitude,state,"
    "sigma_x,sigma_y,sigma_z,sigma_rotation_deg";

/// From name to sigma_rotation_deg. `origin`: null where the pose is not on earth.
void AppendPoseCells(std::string& line, const ReportImage& image, const GeodeticPosition* origin) {
  line += CsvField(image.name);
  if (!image.registered) {
    line += ",,,,,,,,,,,not_registered,,,,";
    return;
  }
  AppendPose(line, image.cam_from_world);
  if (origin != nullptr) {
    AppendGeodetic(line, image.cam_from_world, *origin);
  } else {
    line += ",,,";
  }
  line += ',';
  line += image.StateText();
  AppendUncertainty(line, image.uncertainty);
}

/// From model to residual_px.
void AppendMeasureCells(std::string& line, const ReportImage& image) {
  line += ',';
  if (image.registered) line += std::to_string(image.model);
  line += ',';
  if (image.cluster >= 0) line += std::to_string(image.cluster);
  line += ',';
  if (image.registered) line += std::to_string(image.observations);
  if (image.observations > 0) {
    AppendNumber(line, image.residual_px_mean, 4);
  } else {
    line += ',';
  }
}

}  // namespace

std::string CamerasCsv(const JobReport& report) {
  std::string csv = std::string(kPoseHeader) + ",model,cluster,observations,residual_px\n";
  for (const ReportImage& image : report.images) {
    const bool on_earth = report.origin && report.IsGeoreferenced(image);
    AppendPoseCells(csv, image, on_earth ? &*report.origin : nullptr);
    AppendMeasureCells(csv, image);
    csv += '\n';
  }
  return csv;
}

std::string CamerasCsv(const std::map<ImageId, RegisteredImage>& images,
                       const ImageManifest& manifest,
                       bool georeferenced) {
  std::string csv = std::string(kPoseHeader) + "\n";
  for (const ImageRecord& record : manifest.images) {
    ReportImage row{.name = record.name};
    if (const auto image = images.find(record.id); image != images.end()) {
      row.registered = true;
      row.loose = image->second.loose;
      row.cam_from_world = image->second.cam_from_world;
      row.uncertainty = image->second.uncertainty;
    }
    AppendPoseCells(csv, row, georeferenced && manifest.origin ? &*manifest.origin : nullptr);
    csv += '\n';
  }
  return csv;
}

}  // namespace orbweave
