// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/mapping/model/mapping_state.h"
#include "core/mapping/registration/scene_correspondences.h"

namespace orbweave {

/// What GNSS says of a pose that points propose.
enum class GnssOpinion {
  kNone,          ///< nothing, or that it may be right
  kContradicted,  ///< that it stands elsewhere; or the position is wrong
  kRefused,       ///< that it stands elsewhere, and there is more against it than one position
};

struct GnssVerdict {
  GnssOpinion opinion = GnssOpinion::kNone;
  std::optional<Rigid3> better{};  ///< where it stands instead (PoseOnGnssSteps)
};

/// GNSS is asked where points are not at one: where fewer than three quarters of the image's
/// visible points agree with the pose, or those that do in fewer than 4 places of it (cells of
/// SphereSpread); unless these are 20 places, and half of those that hold points. One position
/// alone proves little, as some are always wrong by tens of metres. But where less than a third of
/// the points agree, or GNSS contradicts an image around as well, a whole piece of the street would
/// go wrong; and a position that others of its drive bear out is not wrong by six sigmas.
[[nodiscard]] GnssVerdict JudgeByGnss(const MappingState& state,
                                      ImageSlot image,
                                      const Rigid3& found,
                                      const SceneCorrespondences& correspondences,
                                      double max_error_rad);

/// Whether the image stands where points are not at one (as above) and its position, which others
/// of its drive bear out, is six sigmas away. However it came to stand there: pairs tell
/// directions, and far points anything.
[[nodiscard]] bool IsGrosslyContradicted(const MappingState& state,
                                         ImageSlot image,
                                         const Rigid3& found,
                                         const SceneCorrespondences& correspondences,
                                         double max_error_rad);

}  // namespace orbweave
