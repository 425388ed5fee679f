// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/cameras_csv.h"

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

}  // namespace

std::string CamerasCsv(const std::map<ImageId, RegisteredImage>& images,
                       const ImageManifest& manifest,
                       bool georeferenced) {
  std::string csv =
      "name,x,y,z,qw,qx,qy,qz,latitude,longitude,altitude,state,"
      "sigma_x,sigma_y,sigma_z,sigma_rotation_deg\n";
  for (const ImageRecord& record : manifest.images) {
    csv += CsvField(record.name);
    const auto image = images.find(record.id);
    if (image == images.end()) {
      csv += ",,,,,,,,,,,not_registered,,,,\n";
      continue;
    }
    AppendPose(csv, image->second.cam_from_world);
    if (georeferenced && manifest.origin) {
      AppendGeodetic(csv, image->second.cam_from_world, *manifest.origin);
    } else {
      csv += ",,,";
    }
    csv += image->second.loose ? ",loose" : ",registered";
    AppendUncertainty(csv, image->second.uncertainty);
    csv += '\n';
  }
  return csv;
}

}  // namespace orbweave
