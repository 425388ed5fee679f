// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "core/mapping/mapping_state.h"

namespace orbweave {

/// Whether positions of these images tell where all of them are: 10 at least, spread (rms distance
/// from their mean, horizontally) by three sigmas.
[[nodiscard]] bool DoPositionsSpread(const ClusterProblem& problem,
                                     std::span<const ImageSlot> images);

/// Of those images that have a position, the share whose centre in east, north and up lies within
/// three horizontal sigmas of it. One at least has a position.
[[nodiscard]] double ShareOnPositions(const ClusterProblem& problem,
                                      std::span<const ImageSlot> images,
                                      const std::function<Eigen::Vector3d(ImageSlot)>& centre_of);

/// Share of the registered images with a GNSS position that come to lie within three horizontal
/// sigmas of it, under the similarity that fits all best (reweighted least squares, Cauchy). Where
/// nearly all do, positions and images agree on the way; where images lost the scale at a crossing,
/// whole streets do not. nullopt, as little can be told: not DoPositionsSpread, or all lie on a
/// line.
[[nodiscard]] std::optional<double> AgreementWithPositions(const MappingState& state);

}  // namespace orbweave
