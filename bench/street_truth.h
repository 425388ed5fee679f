// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/rigid3.h"
#include "core/synthetic/render_street_panorama.h"
#include "core/synthetic/street.h"
#include "core/synthetic/street_options.h"
#include "core/synthetic/street_world.h"

namespace orbweave {

/// What no stereo can be right about is judged apart: panes show what they mirror, and of what
/// moves every panorama sees another place.
enum class SurfaceKind : uint8_t { kStill, kGlass, kMoves };
inline constexpr std::array kSurfaceKinds = {
    SurfaceKind::kStill, SurfaceKind::kGlass, SurfaceKind::kMoves};

inline constexpr double kNearestJudged_m = 2.0;
inline constexpr double kFarthestJudged_m = 15.0;

inline bool IsJudged(double range_m) {
  return range_m > kNearestJudged_m && range_m < kFarthestJudged_m;
}

/// What the rays of an equiangular raster meet of a street without its traffic.
struct RasterTruth {
  int face_px = 0;
  std::vector<float> range_m{};  ///< 0: sky
  std::vector<Eigen::Vector3f> points{};
  std::vector<Eigen::Vector3f> normals{};
  std::vector<SurfaceKind> kinds{};
  std::vector<uint8_t>
      counts{};  ///< of every fourth row and column: near enough, and another sees it

  [[nodiscard]] bool IsNear(size_t pixel) const { return IsJudged(range_m[pixel]); }

  /// Distance of a point from the surface around a pixel: from tangent planes of what its ray and
  /// those beside it hit.
  [[nodiscard]] double ErrorAt(int face, int row, int column, const Eigen::Vector3f& point) const;
};

/// The true surface as the panoramas of a street see it.
class StreetTruth {
 public:
  StreetTruth(const Street& street, const StreetOptions& options);

  [[nodiscard]] const Rigid3& CamFromStreet(size_t i) const { return cams_from_street_[i]; }

  [[nodiscard]] SurfaceHit TraceFrom(size_t i, const Eigen::Vector3d& bearing) const;

  /// Of panorama `own`; what one of the `others` sees counts.
  [[nodiscard]] RasterTruth Of(size_t own, const std::vector<size_t>& others, int face_px) const;

 private:
  [[nodiscard]] LightRay RayFrom(size_t i, const Eigen::Vector3d& bearing) const;
  [[nodiscard]] SurfaceKind KindOf(size_t i, const LightRay& ray, const SurfaceHit& hit) const;
  [[nodiscard]] bool IsSeen(const SurfaceHit& hit, const std::vector<size_t>& others) const;

  const Street& street_;
  StreetOptions options_;
  std::vector<Rigid3> cams_from_street_{};
};

}  // namespace orbweave
