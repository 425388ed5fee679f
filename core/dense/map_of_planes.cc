// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/map_of_planes.h"

#include <algorithm>
#include <cmath>

#include "core/dense/equiangular_raster.h"

namespace orbweave {
namespace {

constexpr int kApron = PlaneField::kApron_px;
constexpr float kSameSigmas = 2.0F;  // between which two are one surface
constexpr float kHeardCost = 0.7F;   // a match that correlates at 0.3 may contradict a plane
constexpr float kLeastSlant = 0.1F;  // cosine between a plane's normal and the ray

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
        heard_cost_(std::max(kHeardCost, largest_cost_)),
        largest_sigma_(static_cast<float>(options.max_sigma)),
        map_(map) {}

  void Enter(int face) {
    face_ = face;
    camera_from_face_ = FaceFromCamera(face).transpose().cast<float>();
  }

  void Write(int row, int column, const Eigen::Vector3f& ray) {
    const size_t pixel = EquiangularRaster{map_.face_px}.Index(face_, row, column);
    const Found own = FoundByMatch(row, column, ray);
    const Found prior = FoundByPrior(row, column, ray);
    if (prior.exists && own.exists) return WriteOneOf(pixel, own, prior, TextureAt(row, column));
    if (prior.exists) return Set(pixel, prior, kDepthPriorOnly);
    if (own.is_sure) Set(pixel, own, 0);
  }

 private:
  /// A surface on a pixel's ray.
  struct Found {
    bool exists = false;
    bool is_sure = false;  ///< else it is too weak to stand alone, but may contradict
    float range_m = 0.0F;
    float sigma = 0.0F;  ///< as a share of the range
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  };

  Found FoundByMatch(int row, int column, const Eigen::Vector3f& ray) const {
    const size_t at = field_.AtPixel(face_, row + kApron, column + kApron);
    if (!(field_.cost[at] < heard_cost_) || !(field_.sigma[at] < largest_sigma_)) return {};
    const Eigen::Vector3f q(field_.x[at], field_.y[at], field_.z[at]);
    return {true,
            field_.cost[at] < largest_cost_,
            ray.norm() / q.dot(ray),
            field_.sigma[at],
            camera_from_face_ * q.normalized()};
  }

  Found FoundByPrior(int row, int column, const Eigen::Vector3f& ray) const {
    if (prior_.labels.empty()) return {};
    const EquiangularRaster raster{prior_.face_px};
    const uint8_t label = prior_.labels[raster.Index(face_, row / 2, column / 2)];
    if (label == PlanarPrior::kNone) return {};
    const Eigen::Vector3f& plane = prior_.planes[label];
    const Eigen::Vector3f in_cam = camera_from_face_ * ray;
    const Eigen::Vector3f normal = plane.normalized();
    const float slant = normal.dot(in_cam.normalized());
    if (slant < kLeastSlant) return {};
    const float range_m = in_cam.norm() / plane.dot(in_cam);
    const float sigma_m = prior_.errors[label].SigmaAt(in_cam.normalized() * range_m) / slant;
    return {true, true, range_m, sigma_m / range_m, normal};
  }

  void WriteOneOf(size_t pixel, const Found& own, const Found& prior, float texture) {
    const float off = own.range_m / prior.range_m - 1.0F;
    const float variance = own.sigma * own.sigma + prior.sigma * prior.sigma;
    const bool agree = off * off < kSameSigmas * kSameSigmas * variance;
    if (agree && own.is_sure) return Set(pixel, Mean(own, prior), 0);
    if (agree || texture < kWeakTexture) return Set(pixel, prior, kDepthPriorOnly);
    if (own.is_sure) Set(pixel, Doubted(own, std::abs(off)), 0);
  }

  /// A match that contradicts a plane: one of both is wrong, by what they are apart.
  [[nodiscard]] Found Doubted(Found own, float off) const {
    if (off < largest_sigma_) own.sigma = std::max(own.sigma, off);
    return own;
  }

  float TextureAt(int row, int column) const {
    const int cells = prior_.face_px / 2;
    return prior_.texture[static_cast<size_t>((face_ * cells + row / 4) * cells + column / 4)];
  }

  /// Of two that agree, each with the weight of its variance.
  static Found Mean(const Found& a, const Found& b) {
    const float weight_a = 1.0F / (a.sigma * a.sigma);
    const float weight_b = 1.0F / (b.sigma * b.sigma);
    const float weights = weight_a + weight_b;
    return {true,
            true,
            (weight_a * a.range_m + weight_b * b.range_m) / weights,
            1.0F / std::sqrt(weights),
            weight_a > weight_b ? a.normal : b.normal};
  }

  void Set(size_t pixel, const Found& found, uint8_t flags) {
    if (!found.exists) return;
    if (!(found.range_m >= limits_.min_m && found.range_m <= limits_.max_m)) return;
    map_.range_m[pixel] = found.range_m;
    map_.sigma_m[pixel] = found.range_m * found.sigma;
    map_.normals[pixel] = EncodeNormal(-found.normal);
    map_.flags[pixel] = flags;
  }

  const PlaneField& field_;
  const PlanarPrior& prior_;
  RangeLimits limits_;
  float largest_cost_;
  float heard_cost_;
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
