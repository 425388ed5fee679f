// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Receivers promise too much between houses: so many times what they state is believed at most.
inline constexpr double kMaxScatter = 5.0;

/// By how much positions scatter over what they state, from their horizontal errors in stated
/// sigmas: the lower quartile over that of two normal components, in [1, kMaxScatter]. So many may
/// be wrong, or of images that are.
[[nodiscard]] double ScatterOfPositions(const std::vector<double>& errors);

/// The same of the images of these that have a position, with centres in east, north and up.
[[nodiscard]] double ScatterAbout(const ClusterProblem& problem,
                                  std::span<const ImageSlot> images,
                                  const std::function<Eigen::Vector3d(ImageSlot)>& centre_of);

/// Whether positions of these images tell where all of them are: 10 at least, spread (rms distance
/// from their mean, horizontally) by three sigmas, which are `scatter` times what is stated.
[[nodiscard]] bool DoPositionsSpread(const ClusterProblem& problem,
                                     std::span<const ImageSlot> images,
                                     double scatter);

/// Of those images that have a position, the share whose centre in east, north and up lies within
/// three horizontal sigmas of it, which are `scatter` times what is stated. One at least has a
/// position.
[[nodiscard]] double ShareOnPositions(const ClusterProblem& problem,
                                      std::span<const ImageSlot> images,
                                      double scatter,
                                      const std::function<Eigen::Vector3d(ImageSlot)>& centre_of);

/// Share of the registered images with a GNSS position that come to lie within three horizontal
/// sigmas of it, of what they prove to be worth (ScatterOfPositions), under the similarity that
/// fits all best (reweighted least squares, Cauchy). Where nearly all do, positions and images
/// agree on the way; where images lost the scale at a crossing, whole streets do not. nullopt, as
/// little can be told: not DoPositionsSpread, or all lie on a line.
[[nodiscard]] std::optional<double> AgreementWithPositions(const MappingState& state);

}  // namespace orbweave
