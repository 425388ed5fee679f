// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/averaging/average_rotations.h"
#include "core/base/random.h"
#include "core/geometry/rotation.h"

namespace orbweave::testing {

inline Eigen::Quaterniond RandomRotation(Random& random) {
  return Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal())
      .normalized();
}

/// A street of panoramas, each turned its own way and joined with the next `window`.
struct RotationStreet {
  std::vector<Eigen::Quaterniond> cam_from_world{};
  ViewGraph graph{};
};

struct RotationStreetOptions {
  uint32_t images = 40;
  uint32_t window = 6;
  double noise_rad = 0.0;  ///< per axis
  double outlier_share = 0.0;
  uint64_t seed = 1;
};

inline RotationStreet MakeRotationStreet(const RotationStreetOptions& options) {
  Random random(options.seed);
  RotationStreet street;
  street.graph.num_images = options.images;
  for (uint32_t i = 0; i < options.images; ++i) {
    street.cam_from_world.push_back(RandomRotation(random));
  }
  for (uint32_t a = 0; a < options.images; ++a) {
    for (uint32_t b = a + 1; b < std::min(options.images, a + 1 + options.window); ++b) {
      const Eigen::Vector3d noise(random.Normal(), random.Normal(), random.Normal());
      const bool is_wrong = random.Uniform() < options.outlier_share;
      const Eigen::Quaterniond truth =
          street.cam_from_world[b] * street.cam_from_world[a].conjugate();
      ViewEdge edge{.pair = {ImageId(a), ImageId(b)}};
      edge.b_from_a.rotation =
          is_wrong ? RandomRotation(random) : RotationFromVector(options.noise_rad * noise) * truth;
      edge.num_inliers = 20 + random.Index(380);
      street.graph.edges.push_back(edge);
    }
  }
  return street;
}

/// Largest angle by which an image is turned otherwise than in truth, seen from image 0.
inline double WorstRotation(const std::vector<Eigen::Quaterniond>& truth,
                            const std::vector<Eigen::Quaterniond>& found) {
  double worst = 0.0;
  for (size_t i = 1; i < truth.size(); ++i) {
    const Eigen::Quaterniond difference =
        (found[i] * found[0].conjugate()) * (truth[i] * truth[0].conjugate()).conjugate();
    worst = std::max(worst, RotationAngle(difference));
  }
  return worst;
}

}  // namespace orbweave::testing
