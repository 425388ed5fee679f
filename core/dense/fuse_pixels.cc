// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/fuse_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "core/dense/panorama_color.h"
#include "core/dense/range_mean.h"
#include "core/dense/standing_map.h"
#include "core/dense/tile_grid.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kTouchFootprints = 1.05 / 3.0;
constexpr double kTouch_px = 0.8;  // farther apart than that nothing touches
constexpr double kMaxShiftFootprints = 1.0 / 3.0;
constexpr double kNormalSigma_rad = 0.05;

bool IsUsable(const PosedDepthMap& posed) {
  return posed.map != nullptr && posed.map->face_px > 0 &&
         posed.cam_from_world.translation.allFinite() &&
         posed.cam_from_world.rotation.coeffs().allFinite();
}

double ApartInPixels(const Vector3d& way, const Vector3d& ray, double pixel_angle) {
  return (way.normalized() - ray).norm() / pixel_angle;
}

/// Least distance of apart + s a and t b, |s| and |t| up to `half`; a and b are unit vectors.
double DistanceOfSegments(const Vector3d& apart,
                          const Vector3d& a,
                          const Vector3d& b,
                          double half) {
  const double cosine = a.dot(b);
  const double along_a = a.dot(apart);
  const double along_b = b.dot(apart);
  const double sine_squared = 1.0 - cosine * cosine;
  double s = sine_squared > 1e-12 ? (cosine * along_b - along_a) / sine_squared : 0.0;
  s = std::clamp(s, -half, half);
  const double t = std::clamp(along_b + s * cosine, -half, half);
  s = std::clamp(t * cosine - along_a, -half, half);
  return (apart + s * a - t * b).norm();
}

class Fuser {
 public:
  Fuser(const PosedDepthMap& own,
        std::span<const PosedDepthMap> neighbours,
        const FuseOptions& options)
      : options_(options),
        min_cosine_(std::cos(options.max_normal_angle_deg * std::numbers::pi / 180.0)),
        origin_(own.cam_from_world.Centre()),
        own_(own, origin_) {
    for (const PosedDepthMap& posed : neighbours) {
      if (IsUsable(posed) && posed.image != own.image) maps_.emplace_back(posed, origin_);
    }
    std::ranges::sort(maps_, {}, [](const StandingMap& map) { return map.image(); });
    met_.resize(maps_.size());
  }

  [[nodiscard]] bool IsChecked(size_t pixel) const { return own_.IsChecked(pixel); }

  /// nullopt when the pixel yields, or too few maps agree.
  [[nodiscard]] std::optional<SurfacePoint> PointOf(size_t pixel, const PanoramaRaster& image) {
    const PixelSample own = own_.SampleOf(pixel);
    OrderMaps(own.point);
    for (const auto& [footprint, map] : order_) {
      if (!Meet(own, map)) return std::nullopt;
    }
    RangeMean mean;
    const auto range_m = static_cast<double>(own_.map().range_m[pixel]);
    mean.Add(range_m, own.sigma_m, own.normal);
    for (const std::optional<PixelSample>& other : met_) {
      if (other) AddPlane(own, *other, mean);
    }
    if (mean.size() < static_cast<size_t>(options_.min_maps)) return std::nullopt;
    double footprint = own_.Footprint(own.point);
    if (!order_.empty()) footprint = std::min(footprint, order_.front().first);
    const double shift_m =
        std::max(0.0, kMaxShiftFootprints * footprint - 2.0 * kPositionQuantum_m);
    const double fused_m = std::clamp(mean.Range(), range_m - shift_m, range_m + shift_m);
    const size_t views = std::max<size_t>(mean.size(), own_.map().views[pixel] + size_t{1});
    SurfacePoint point;
    point.position_in_world = QuantisedPosition(origin_ + fused_m * own.ray);
    point.normal_in_world = mean.Normal().cast<float>();
    point.color = ColorAlong(image, own_.bearings().Of(pixel));
    point.sigma_m = static_cast<float>(mean.Sigma());
    point.views = static_cast<uint8_t>(std::min<size_t>(views, 255));
    return point;
  }

 private:
  /// Those first that see the point finest: most pixels yield to one of them.
  void OrderMaps(const Vector3d& point) {
    order_.clear();
    for (size_t i = 0; i < maps_.size(); ++i) order_.emplace_back(maps_[i].Footprint(point), i);
    std::ranges::sort(order_);
  }

  /// Keeps what agrees in a map. False when the sample yields to one of its pixels.
  bool Meet(const PixelSample& own, size_t index) {
    const StandingMap& map = maps_[index];
    std::optional<PixelSample>& nearest = met_[index];
    nearest.reset();
    const Vector3d way = own.point - map.centre();
    if (!(way.norm() > 0.0)) return true;
    double nearest_px = std::numeric_limits<double>::infinity();
    map.Around(way.normalized(), std::max(options_.max_reprojection_px, kTouch_px), pixels_);
    for (const size_t pixel : pixels_) {
      if (!map.IsChecked(pixel)) continue;
      const PixelSample other = map.SampleOf(pixel);
      const double apart_px = std::max(ApartInPixels(way, other.ray, map.PixelAngle()),
                                       ApartInPixels(other.point, own.ray, own_.PixelAngle()));
      const bool agrees = apart_px < options_.max_reprojection_px && Agree(own, other);
      if (other.rank < own.rank &&
          ((agrees && apart_px < options_.yield_px) || Touch(own, other, map))) {
        return false;
      }
      if (agrees && apart_px < nearest_px) {
        nearest_px = apart_px;
        nearest = other;
      }
    }
    return true;
  }

  /// Whether both may end up too near to each other, wherever they are moved along their rays.
  [[nodiscard]] bool Touch(const PixelSample& own,
                           const PixelSample& other,
                           const StandingMap& map) const {
    const double footprint = std::min(own_.Footprint(own.point), map.Footprint(own.point));
    const double shift_m = kMaxShiftFootprints * footprint;
    const double limit_m = kTouchFootprints * footprint;
    const Vector3d apart = own.point - other.point;
    if (apart.norm() > limit_m + 2.0 * shift_m) return false;
    return DistanceOfSegments(apart, own.ray, other.ray, shift_m) < limit_m;
  }

  /// All but that each is seen near the other's ray.
  [[nodiscard]] bool Agree(const PixelSample& own, const PixelSample& other) const {
    if (own.normal.dot(other.normal) < min_cosine_) return false;
    const Vector3d apart = own.point - other.point;
    const double own_sigma = own.sigma_m * other.normal.dot(own.ray);
    const double other_sigma = other.sigma_m * other.normal.dot(other.ray);
    const double slack = kNormalSigma_rad * apart.norm();
    const double variance = own_sigma * own_sigma + other_sigma * other_sigma + slack * slack;
    const double off_plane = other.normal.dot(apart);
    return off_plane * off_plane <=
           options_.max_depth_sigmas * options_.max_depth_sigmas * variance;
  }

  /// Where the ray of `own` meets the plane of `other`.
  void AddPlane(const PixelSample& own, const PixelSample& other, RangeMean& mean) const {
    constexpr double kGrazing = 0.02;
    const double cosine = other.normal.dot(own.ray);
    if (std::abs(cosine) < kGrazing) return;
    const double range_m = other.normal.dot(other.point - own_.centre()) / cosine;
    const double along_normal = other.sigma_m * other.normal.dot(other.ray);
    const double slack = kNormalSigma_rad * (own.point - other.point).norm();
    mean.Add(range_m, std::hypot(along_normal, slack) / std::abs(cosine), other.normal);
  }

  FuseOptions options_;
  double min_cosine_;
  Vector3d origin_;
  StandingMap own_;
  std::vector<StandingMap> maps_{};                 ///< by image
  std::vector<std::pair<double, size_t>> order_{};  ///< footprint and place in maps_
  std::vector<std::optional<PixelSample>> met_{};   ///< per map: what agrees best
  std::vector<size_t> pixels_{};                    ///< room for Meet
};

}  // namespace

FusedPanorama FusePixels(const PosedDepthMap& own,
                         const PanoramaRaster& own_image,
                         std::span<const PosedDepthMap> neighbours,
                         const FuseOptions& options) {
  FusedPanorama fused;
  if (own.map == nullptr || own.map->face_px <= 0) {
    fused.problem =
        own.map == nullptr || own.map->problem.empty() ? "it has no depth map" : own.map->problem;
    return fused;
  }
  if (!IsUsable(own)) {
    fused.problem = "its pose is not finite";
    return fused;
  }
  Fuser fuser(own, neighbours, options);
  for (size_t pixel = 0; pixel < own.map->size(); ++pixel) {
    if (!fuser.IsChecked(pixel)) continue;
    ++fused.checked_pixels;
    if (const auto point = fuser.PointOf(pixel, own_image)) fused.points.push_back(*point);
  }
  if (fused.checked_pixels == 0) fused.problem = "none of its depths was borne out by others";
  return fused;
}

}  // namespace orbweave
