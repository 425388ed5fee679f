// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/dense/depth_problem.h"
#include "core/geometry/equirectangular_camera.h"
#include "core/geometry/rigid3.h"

/// The inside of a box with texture all over it, for tests of depth maps.
namespace orbweave::testing {

inline const Eigen::Vector3d kBoxHalf_m(4.0, 2.5, 3.0);

/// Where a ray from inside the box leaves it.
inline double RangeInBox(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double range_m = 1e9;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) continue;
    const double wall_m = direction[k] > 0.0 ? kBoxHalf_m[k] : -kBoxHalf_m[k];
    range_m = std::min(range_m, (wall_m - origin[k]) / direction[k]);
  }
  return range_m;
}

/// The wall's inward normal at a point of it.
inline Eigen::Vector3d NormalInBox(const Eigen::Vector3d& point) {
  Eigen::Index axis = 0;
  point.cwiseAbs().cwiseQuotient(kBoxHalf_m).maxCoeff(&axis);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  normal[axis] = point[axis] > 0.0 ? -1.0 : 1.0;
  return normal;
}

/// Waves of several lengths and directions, 128 on average.
inline double LevelInBox(const Eigen::Vector3d& p) {
  double level = 128.0;
  for (int k = 0; k < 6; ++k) {
    const double angle = 0.7 + 1.3 * k;
    const Eigen::Vector3d wave(std::cos(angle), std::sin(1.7 * angle), std::sin(angle));
    level += 18.0 * std::sin(wave.dot(p) * (7.0 + 3.1 * k) + k);
  }
  return std::clamp(level, 0.0, 255.0);
}

struct BoxImage {
  int width_px = 0;
  Rigid3 cam_from_box{};
  std::vector<uint8_t> levels{};
  std::vector<uint8_t> ignored{};

  [[nodiscard]] PanoramaRaster Raster() const {
    return {width_px, width_px / 2, 1, levels, ignored};
  }
  /// Range that the panorama has along a bearing.
  [[nodiscard]] double RangeAlong(const Eigen::Vector3d& bearing) const {
    return RangeInBox(cam_from_box.Centre(), cam_from_box.rotation.conjugate() * bearing);
  }
};

inline BoxImage RenderBox(int width_px, const Rigid3& cam_from_box) {
  BoxImage image{width_px, cam_from_box};
  const EquirectangularCamera camera{width_px, width_px / 2};
  const Eigen::Vector3d centre = cam_from_box.Centre();
  for (int row = 0; row < width_px / 2; ++row) {
    for (int column = 0; column < width_px; ++column) {
      const Eigen::Vector3d direction =
          cam_from_box.rotation.conjugate() * camera.BearingFromPixel({column + 0.5, row + 0.5});
      const Eigen::Vector3d point = centre + RangeInBox(centre, direction) * direction;
      image.levels.push_back(static_cast<uint8_t>(std::lround(LevelInBox(point))));
    }
  }
  return image;
}

/// A reference at the middle of the box, turned by a rotation, and four sources around it.
struct BoxScene {
  explicit BoxScene(int width_px, const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity())
      : reference(RenderBox(width_px, Rigid3::FromCentre(turn, Eigen::Vector3d::Zero()))) {
    for (const Eigen::Vector3d& centre : {Eigen::Vector3d(0.5, 0.1, 0.1),
                                          Eigen::Vector3d(-0.5, 0.0, -0.1),
                                          Eigen::Vector3d(0.1, -0.1, 0.5),
                                          Eigen::Vector3d(0.0, 0.4, -0.3)}) {
      sources.push_back(
          RenderBox(width_px, Rigid3::FromCentre(Eigen::Quaterniond::Identity(), centre)));
    }
  }

  [[nodiscard]] DepthProblem Problem() const {
    DepthProblem problem{
        .reference = reference.Raster(), .min_range_m = 1.0, .max_range_m = 20.0, .seed = 7};
    for (const BoxImage& source : sources) {
      problem.sources.push_back(
          {source.Raster(), source.cam_from_box * reference.cam_from_box.Inverse()});
    }
    return problem;
  }

  BoxImage reference;
  std::vector<BoxImage> sources{};
};

}  // namespace orbweave::testing
