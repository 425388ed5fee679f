// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/sim3.h"

namespace orbweave {

/// How well two submodels fit; indices into the submodel list, a < b.
struct SeamReport {
  uint32_t submodel_a = 0;
  uint32_t submodel_b = 0;
  uint32_t common_images = 0;
  uint32_t common_tracks = 0;
  uint32_t inlier_tracks = 0;
  double condition_number = 0.0;
  bool used = true;
  bool contradicted = false;  ///< by loops, hence not used
  /// By how many times more than expected the submodels bend and stretch, as their loops have it.
  double drift_factor = 1.0;
  std::string reason{};  ///< why it is not used
  double position_jump_m =
      0.0;  ///< median distance of common centres after alignment, units of the world
  double rotation_jump_deg = 0.0;  ///< median
};

/// Whose part a submodel is, and how many images it holds.
struct SubmodelExtent {
  uint32_t cluster = 0;
  uint32_t num_images = 0;
};

/// World frames: connected submodels share one.
struct Alignment {
  std::vector<Sim3> world_from_submodel{};
  std::vector<uint32_t> world{};  ///< per submodel: index of its world, 0 has the most images
  std::vector<SubmodelExtent> submodels{};
  std::vector<SeamReport> seams{};  ///< every two submodels with a common image, sorted by (a, b)
};

}  // namespace orbweave
