// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/map_of_planes.h"

#include <cmath>

#include "core/dense/equiangular_raster.h"

namespace orbweave {
namespace {

constexpr int kApron = PlaneField::kApron_px;
constexpr float kPriorSigmas = 3.0F;

DepthMap BlankMap(int face_px) {
  DepthMap map{.face_px = face_px};
  const size_t count = EquiangularRaster{face_px}.NumPixels();
  map.range_m.resize(count);
  map.normals.resize(count);
  map.sigma_m.resize(count);
  map.views.resize(count);
  map.flags.resize(count);
  return map;
}

/// One face of the map, pixel after pixel.
class FaceWriter {
 public:
  FaceWriter(const PlaneField& field,
             const PlanarPrior& prior,
             const RangeLimits& limits,
             const DenseOptions& options,
             DepthMap& map)
      : field_(field),
        prior_(prior),
        limits_(limits),
        largest_cost_(static_cast<float>(1.0 - options.min_zncc)),
        largest_sigma_(static_cast<float>(options.max_sigma)),
        map_(map) {}

  void Enter(int face) {
    face_ = face;
    camera_from_face_ = FaceFromCamera(face).transpose().cast<float>();
  }

  void Write(int row, int column, const Eigen::Vector3f& ray) {
    const size_t at = field_.AtPixel(face_, row + kApron, column + kApron);
    const size_t pixel = EquiangularRaster{map_.face_px}.Index(face_, row, column);
    const Eigen::Vector3f q(field_.x[at], field_.y[at], field_.z[at]);
    if (field_.cost[at] < largest_cost_ && field_.sigma[at] < largest_sigma_) {
      return Set(pixel, camera_from_face_ * q, ray, field_.sigma[at], 0);
    }
    if (prior_.labels.empty()) return;
    const uint8_t label =
        prior_.labels[EquiangularRaster{prior_.face_px}.Index(face_, row / 2, column / 2)];
    if (label == PlanarPrior::kNone) return;
    const Eigen::Vector3f& plane = prior_.planes[label];
    const Eigen::Vector3f in_cam = camera_from_face_ * ray;
    const float slant = plane.normalized().dot(in_cam.normalized());
    if (slant < kLeastSlant) return;
    const float range_m = in_cam.norm() / plane.dot(in_cam);
    Set(pixel,
        plane,
        ray,
        kPriorSigmas * prior_.scatter_m[label] / (slant * range_m),
        kDepthPriorOnly);
  }

 private:
  static constexpr float kLeastSlant = 0.1F;  // cosine between a plane's normal and the ray

  void Set(size_t pixel,
           const Eigen::Vector3f& q,
           const Eigen::Vector3f& ray,
           float sigma,
           uint8_t flags) {
    const float range_m = ray.norm() / q.dot(camera_from_face_ * ray);
    if (!(range_m >= limits_.min_m && range_m <= limits_.max_m)) return;
    map_.range_m[pixel] = range_m;
    map_.sigma_m[pixel] = range_m * sigma;
    map_.normals[pixel] = EncodeNormal(-q.normalized());
    map_.flags[pixel] = flags;
  }

  const PlaneField& field_;
  const PlanarPrior& prior_;
  RangeLimits limits_;
  float largest_cost_;
  float largest_sigma_;
  DepthMap& map_;
  int face_ = 0;
  Eigen::Matrix3f camera_from_face_ = Eigen::Matrix3f::Identity();
};

}  // namespace

DepthMap MapOfPlanes(const ReferenceRaster& raster,
                     const PlaneField& field,
                     const PlanarPrior& prior,
                     const RangeLimits& limits,
                     const DenseOptions& options) {
  DepthMap map = BlankMap(field.FacePx());
  FaceWriter writer(field, prior, limits, options, map);
  for (int face = 0; face < kCubeFaces; ++face) {
    const auto& ignored = raster.ignored[static_cast<size_t>(face)];
    writer.Enter(face);
    for (int row = 0; row < map.face_px; ++row) {
      for (int column = 0; column < map.face_px; ++column) {
        const auto in_raster =
            static_cast<size_t>((row + kApron) * raster.Stride() + column + kApron);
        if (!ignored.empty() && ignored[in_raster] != 0) continue;
        writer.Write(row,
                     column,
                     {raster.tangents[static_cast<size_t>(column + kApron)],
                      raster.tangents[static_cast<size_t>(row + kApron)],
                      1.0F});
      }
    }
  }
  return map;
}

}  // namespace orbweave
