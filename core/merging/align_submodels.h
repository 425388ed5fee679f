// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/base/stage_context.h"
#include "core/geometry/sim3.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

struct AlignOptions {
  int min_common_images = 3;
  double max_error_px = 8.0;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("min_common_images", self.min_common_images, "seams with fewer common images are not trusted alone", Range{1, 1000});
    visit("max_error_px", self.max_error_px, "common tracks further apart do not vote on a seam", Range{0.1, 1000});
  }
};

/// One submodel to be placed: component `component` of cluster `cluster`.
struct Submodel {
  uint32_t cluster = 0;
  uint32_t component = 0;
  Reconstruction reconstruction{};
};

/// How well two submodels fit; indices into the submodel list, a < b.
struct SeamReport {
  uint32_t submodel_a = 0;
  uint32_t submodel_b = 0;
  uint32_t common_images = 0;
  uint32_t common_tracks = 0;
  uint32_t inlier_tracks = 0;
  double condition_number = 0.0;
  bool used = true;
  std::string reason{};               ///< why it is not used
  double position_jump_m = 0.0;       ///< median distance of common centres after alignment
  double rotation_jump_deg = 0.0;     ///< median
};

/// World frames: connected submodels share one; each GNSS-placed world is east-north-up metres.
struct Alignment {
  std::vector<Sim3> world_from_submodel{};
  std::vector<uint32_t> world{};  ///< per submodel: index of its world, 0 has the most images
  std::vector<SeamReport> seams{};
};

/// Robust relative Sim3 per seam from common images (rotation, centre) and common tracks, then one
/// robust pose graph over all submodels. GNSS enters in GeoreferenceReconstruction.
[[nodiscard]] absl::StatusOr<Alignment> AlignSubmodels(const std::vector<Submodel>& submodels,
                                                       const AlignOptions& options,
                                                       const StageContext& context);

}  // namespace orbweave
