// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/geometry/sim3.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Positions agree with a model when so large a share of them lies within so many sigmas of where
/// it has them.
inline constexpr double kMinAgreeingFixes = 0.7;
inline constexpr double kMaxFixSigmas = 3.0;

/// The registered images, or those of `images`, that are nearest to `place`, 30 at most,
/// ascending: so many that GNSS carries the scale, and so few that drift along the street does not
/// matter, nor a fold elsewhere.
[[nodiscard]] std::vector<ImageSlot> ImagesNear(const MappingState& state,
                                                const Eigen::Vector3d& place);
[[nodiscard]] std::vector<ImageSlot> ImagesNear(const MappingState& state,
                                                const Eigen::Vector3d& place,
                                                std::vector<ImageSlot> images);

/// Where a submodel stands by the GNSS of some of its images, as far as that is needed to tell
/// which way the street goes on from there: the similarity to east, north, up that keeps the
/// cameras' mean "up" vertical, from the horizontal positions by reweighted least squares (Cauchy).
/// Four unknowns, so that a straight street determines them too.
///
/// nullopt: fewer than 4 positions; cameras that do not agree which way is up (a rig that tilts, or
/// panoramas turned at random); positions that hardly spread beyond their own sigma, or of which
/// less than 70 % agree within three.
[[nodiscard]] std::optional<Sim3> PlaceOnGnss(const MappingState& state,
                                              std::span<const ImageSlot> images);

}  // namespace orbweave
