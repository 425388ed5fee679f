// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/bundle/block_matrix.h"
#include "core/partitioned_ba/subproblem.h"

namespace orbweave {

/// Bands and sectors of SphereCell: a patch is a sixteenth of the sphere, 90 by 30 degrees beside
/// the street. A bus, a facade that repeats or a stitching fault fits into one.
constexpr int kSupportBands = 4;

/// What the observations in one patch of one panorama say of its pose, points as uncertain as the
/// others that see them leave them, all other poses as adjusted. With M the Hessian of an
/// observation by its point, H_o the sum of those of the other observations of the point, and A as
/// in PlaceBySides, it is A (M - M (M + H_o)^-1 M) A^T: two equations where two others or more hold
/// the point, one (the epipolar plane) where one does. (w, C) as in PoseCovariances.
struct PatchSupport {
  ImageId image{};
  uint32_t patch = 0;         ///< of the bearing, SphereCell with kSupportBands
  uint32_t observations = 0;  ///< of points that others hold
  uint32_t equations = 0;     ///< two or one each
  Block6 hessian = Block6::Zero();
  Vector6 gradient = Vector6::Zero();  ///< of half the sum of squares
  double sum_of_squares = 0.0;         ///< of errors over their sigmas
  double redundancy = 0.0;             ///< its share: 2 - 3 / n of a point that n images see
};

/// Sorted by image and patch. Of a track that is split over subproblems the part that is here
/// counts. `without`: as if these images had seen nothing.
[[nodiscard]] std::vector<PatchSupport> SupportOf(const Subproblem& subproblem,
                                                  const std::set<ImageId>& without = {});

/// Adds what several subproblems know of the same patches; sums in the order given.
void AddSupport(std::span<const PatchSupport> patches,
                std::map<ImageId, std::vector<PatchSupport>>& of_image);

/// Whether an image's own observations place it.
struct SupportVerdict {
  bool is_weak = false;
  std::string reason{};  ///< what was found, where weak
  /// A-posteriori over claimed variance: of the bearings, 1 where nothing is redundant ...
  double scatter = 1.0;
  /// ... and of what whole patches say of the pose, over what that scatter leads one to expect; 1
  /// where few patches say much. More: errors go together within patches, and many observations
  /// know less than their number.
  double coherence = 1.0;
};

/// An image is placed when no single patch decides. For each patch in turn, what the others say
/// must
/// - hold the pose: with positions in units of the typical depth, three standard deviations of
///   every combination of the six unknowns, scaled by `scatter`, stay below 0.1 rad, the angle
///   under which the next image of a street sees a point differently (2 m of 20 m);
/// - check it: as many equations beyond the six unknowns as there are unknowns. One equation agrees
///   by chance in a few of a hundred cases (a band of twice 4 px in the disparities of a street,
///   tenths of a radian), so that six do in 1e-9, and of the thousands of ways in which matches of
///   one panorama can be chosen none is expected to.
/// `patches` are of one image.
[[nodiscard]] SupportVerdict JudgeSupport(std::span<const PatchSupport> patches);

}  // namespace orbweave
