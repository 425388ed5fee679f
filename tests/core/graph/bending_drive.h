// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <set>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "tests/core/graph/graph_samples.h"

namespace orbweave {

inline constexpr double kStep_m = 8.0;
inline constexpr double kSigma_m = 1.0;

/// A drive round a wide bend, with cameras that look anywhere and stand upright to a few degrees.
struct BendingDrive {
  std::vector<Rigid3> cams_from_world{};
  ImageManifest manifest{};

  explicit BendingDrive(uint32_t count, uint64_t seed = 5) {
    Random random(seed);
    // World: east, north, up; cameras: right, down, forward.
    const Eigen::Quaterniond level((Eigen::Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished());
    for (uint32_t i = 0; i < count; ++i) {
      const double angle = 0.05 * i;
      const Eigen::Vector3d centre = 160.0 * Eigen::Vector3d(std::sin(angle), std::cos(angle), 0.0);
      const Eigen::Quaterniond turn(
          Eigen::AngleAxisd(random.Uniform(-3.0, 3.0), Eigen::Vector3d::UnitY()));
      const Eigen::Quaterniond tilt = RotationFromVector(
          0.03 * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()));
      cams_from_world.push_back(Rigid3::FromCentre((tilt * turn * level).normalized(), centre));
      ImageRecord image{.id = ImageId(i)};
      image.prior.position_in_enu =
          centre + kSigma_m * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
      image.prior.horizontal_sigma_m = kSigma_m;
      manifest.images.push_back(image);
    }
  }

  [[nodiscard]] ViewEdge TrueEdge(uint32_t a, uint32_t b) const {
    ViewEdge edge = Edge(a, b);
    edge.b_from_a = cams_from_world[b] * cams_from_world[a].Inverse();
    edge.b_from_a.translation.normalize();
    return edge;
  }

  /// Every window taken for the next: the right rotation, backwards.
  [[nodiscard]] ViewEdge BackwardEdge(uint32_t a, uint32_t b) const {
    ViewEdge edge = TrueEdge(a, b);
    edge.b_from_a.translation *= -1.0;
    return edge;
  }

  [[nodiscard]] std::vector<ViewEdge> Edges(uint32_t window,
                                            const std::set<ImagePair>& backward) const {
    std::vector<ViewEdge> edges;
    const auto count = static_cast<uint32_t>(cams_from_world.size());
    for (uint32_t a = 0; a < count; ++a) {
      for (uint32_t b = a + 1; b <= a + window && b < count; ++b) {
        const bool is_backward = backward.contains({ImageId(a), ImageId(b)});
        edges.push_back(is_backward ? BackwardEdge(a, b) : TrueEdge(a, b));
      }
    }
    return edges;
  }
};

}  // namespace orbweave
