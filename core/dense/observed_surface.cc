// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/observed_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/cube_face.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr PinholeFace kFace = {512};
constexpr double kHalfSquare = 0.75;   // of a sample, spacings
constexpr double kSlackSamples = 8.0;  // spacings

bool InReach(const Vector3d& ray, const SurfaceRegion& region) {
  const double range_m = ray.norm();  // of what is not finite, in no reach
  return range_m >= region.min_range_m && range_m <= region.max_range_m;
}

/// The nearest depth in each direction from a camera, on six faces.
class DepthBuffer {
 public:
  DepthBuffer() : nearest_m_(6 * Size() * Size(), std::numeric_limits<float>::infinity()) {}

  /// The square of half a width `half_m` about the end of a ray.
  void Cover(const Vector3d& ray, double half_m) {
    for (int face = 0; face < kCubeFaces; ++face) {
      const Vector3d in_face = FaceFromCamera(face) * ray;
      if (in_face.z() <= half_m) continue;
      const Eigen::Vector2d pixel = kFace.PixelFromBearing(in_face);
      const double half_px = kFace.Focal_px() * half_m / in_face.z();
      const double edge = kFace.size_px - 1;
      const Eigen::Vector2d low = (pixel.array() - half_px).floor().max(0.0);
      const Eigen::Vector2d high = (pixel.array() + half_px).floor().min(edge);
      for (auto row = static_cast<int>(low.y()); row <= static_cast<int>(high.y()); ++row) {
        for (auto column = static_cast<int>(low.x()); column <= static_cast<int>(high.x());
             ++column) {
          float& nearest = nearest_m_[Index(face, row, column)];
          nearest = std::min(nearest, static_cast<float>(ray.norm()));
        }
      }
    }
  }

  [[nodiscard]] double NearestAlong(const Vector3d& ray) const {
    const int face = FaceOf(ray);
    const Eigen::Vector2d pixel = kFace.PixelFromBearing(FaceFromCamera(face) * ray);
    const Eigen::Vector2d inside = pixel.array().max(0.0).min(kFace.size_px - 1.0);
    return static_cast<double>(
        nearest_m_[Index(face, static_cast<int>(inside.y()), static_cast<int>(inside.x()))]);
  }

 private:
  static constexpr size_t Size() { return static_cast<size_t>(kFace.size_px); }
  static size_t Index(int face, int row, int column) {
    return (static_cast<size_t>(face) * Size() + static_cast<size_t>(row)) * Size() +
           static_cast<size_t>(column);
  }

  std::vector<float> nearest_m_;
};

}  // namespace

std::vector<uint8_t> CountInReach(std::span<const Vector3d> points, const SurfaceRegion& region) {
  std::vector<uint8_t> counts(points.size(), 0);
  for (const Vector3d& centre : region.centres) {
    for (size_t i = 0; i < points.size(); ++i) {
      if (InReach(points[i] - centre, region) && counts[i] < 255) ++counts[i];
    }
  }
  return counts;
}

std::vector<uint8_t> CountObservers(std::span<const Vector3d> points, const SurfaceRegion& region) {
  if (region.sample_spacing_m <= 0.0) return CountInReach(points, region);
  std::vector<uint8_t> counts(points.size(), 0);
  for (const Vector3d& centre : region.centres) {
    DepthBuffer buffer;
    for (const Vector3d& point : points) {
      const Vector3d ray = point - centre;
      const double range_m = ray.norm();
      if (range_m > region.sample_spacing_m && range_m <= region.max_range_m) {
        buffer.Cover(ray, kHalfSquare * region.sample_spacing_m);
      }
    }
    const double slack_m = kSlackSamples * region.sample_spacing_m;
    for (size_t i = 0; i < points.size(); ++i) {
      const Vector3d ray = points[i] - centre;
      if (!InReach(ray, region) || ray.norm() > buffer.NearestAlong(ray) + slack_m) continue;
      if (counts[i] < 255) ++counts[i];
    }
  }
  return counts;
}

}  // namespace orbweave
