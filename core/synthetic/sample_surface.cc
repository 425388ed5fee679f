// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/sample_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace orbweave {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written in the machine's order");

Rgb Rounded(const Colour& colour) {
  const auto level = [](double value) {
    return static_cast<uint8_t>(std::clamp(std::lround(255.0 * value), 0L, 255L));
  };
  return {level(colour.x()), level(colour.y()), level(colour.z())};
}

}  // namespace

SurfaceSamples SampleSurface(const Street& street, size_t i, int columns) {
  const EquirectangularCamera raster{columns, columns / 2};
  const Rigid3& cam_from_enu = street.cams_from_enu[i];
  const Eigen::Matrix3d enu_from_cam = cam_from_enu.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d centre_in_street = cam_from_enu.Centre() - street.street_in_enu;
  const Traffic none({});
  const StreetWorld& world = street.WorldOf(i);
  SurfaceSamples samples;
  for (int row = 0; row < raster.height_px; ++row) {
    for (int column = 0; column < raster.width_px; ++column) {
      const Eigen::Vector3d bearing = raster.BearingFromPixel({column + 0.5, row + 0.5});
      const LightRay ray{centre_in_street, enu_from_cam * bearing};
      const SurfaceHit hit = Trace(world, none, ray);
      if (hit.surface == SurfaceHit::kSky) continue;
      samples.points_in_enu.push_back(hit.point + street.street_in_enu);
      samples.colors.push_back(Rounded(Shade(world, none, ray, hit, raster.AngleFromPixels(1.0))));
    }
  }
  return samples;
}

std::string PlyFromSamples(const SurfaceSamples& samples) {
  std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                    std::to_string(samples.points_in_enu.size()) +
                    "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                    "property uchar green\nproperty uchar blue\nend_header\n";
  ply.reserve(ply.size() + 15 * samples.points_in_enu.size());
  for (size_t k = 0; k < samples.points_in_enu.size(); ++k) {
    const Eigen::Vector3f point = samples.points_in_enu[k].cast<float>();
    char vertex[15];
    std::memcpy(vertex, point.data(), 12);
    vertex[12] = static_cast<char>(samples.colors[k].r);
    vertex[13] = static_cast<char>(samples.colors[k].g);
    vertex[14] = static_cast<char>(samples.colors[k].b);
    ply.append(vertex, sizeof(vertex));
  }
  return ply;
}

}  // namespace orbweave
