// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/stage_context.h"
#include "core/mapping/model/correspondence_graph.h"
#include "core/mapping/model/mapping_options.h"

namespace orbweave {

/// Where all pairs together say that images are, in a frame and scale of their own.
struct PairPlacement {
  std::vector<ImageSlot> images{};        ///< ascending
  std::vector<Rigid3> cams_from_world{};  ///< per image
  /// Where the frame is east, north and up in metres: by what stated sigmas of positions are to be
  /// multiplied, as they are off between neighbours (FactorOfSteps) or, if that is more than 1, as
  /// they scatter (EnuPlacement::scatter).
  std::optional<double> position_factor{};
  std::vector<double> height_offset_m{};  ///< there, as in EnuPlacement
};

/// Poses of all images at once from pairs alone: rotations by AverageRotations, lengths of
/// baselines by AverageBaselines, then centres that agree with most displacements, C_b - C_a = s
/// R_a^T c with the unit baseline c in camera a (AverageDifferences). Noise of the rays turns a
/// baseline the more the smaller the angles under which points see it: a displacement is as exact
/// as s / angle. Where GNSS has steps their lengths take part, and with positions enough
/// (PlaceInEnu) centres are in east, north and up and agree with these too. Pairs whose rotation
/// most others contradict take no part; those without depth give no displacement. Holds the largest
/// set of `available` images that displacements join, which may be empty. Good to the exactness of
/// pairs: a start for an adjustment. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<PairPlacement> PlaceByPairs(const ClusterProblem& problem,
                                                         const CorrespondenceGraph& graph,
                                                         std::span<const uint8_t> available,
                                                         const MappingOptions& options,
                                                         const StageContext& context);

}  // namespace orbweave
