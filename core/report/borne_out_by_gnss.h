// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/graph/positions_by_motion.h"
#include "core/report/job_results.h"

namespace orbweave {

/// Panoramas see of each other's place within so many usual steps.
inline constexpr double kSeenWithin_steps = 3.0;

/// Which panoramas stand where GNSS has the street around them. A model that is folded onto itself,
/// or left a stretch out, puts some of them elsewhere than their positions; one that has them all
/// where they should be does not look alike at two places, its images do.
///
/// A panorama is borne out when of the positions of its own and the five before and after it in its
/// drive, three at least, three quarters lie within three sigmas of where the georeferenced model
/// has theirs, horizontally; what the motion of the drive shows to be off (PositionsByMotion)
/// counts as where the drive went.
class BorneOutByGnss {
 public:
  explicit BorneOutByGnss(const JobResults& results);

  /// Whether both images are borne out, in one model, further apart there than panoramas see of
  /// each other's place: by kSeenWithin_steps of their drives (UsualStep) and three sigmas. A
  /// verified pair of theirs that contradicts the model shows places that look alike.
  [[nodiscard]] bool AreApart(const ImagePair& pair) const;

 private:
  /// A panorama that is borne out.
  struct Place {
    size_t model = 0;
    Eigen::Vector2d in_enu = Eigen::Vector2d::Zero();
    double reach_m = 0.0;
  };

  void TakeDrive(const ImageManifest& manifest,
                 const std::vector<PositionByMotion>& by_motion,
                 const std::vector<ImageId>& sequence);

  std::vector<std::optional<Place>> places_;  ///< per image
};

}  // namespace orbweave
