// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/mapping/model/cluster_problem.h"
#include "core/mapping/positioning/pair_directions.h"

namespace orbweave {

/// Receivers promise too much between houses: what they state is taken for so many times as much,
/// at least.
inline constexpr double kLeastScatter = 2.0;
/// Standard deviation of a step that is as long as those about it, as a share of it.
inline constexpr double kStepShare = 0.3;

/// What a pair says of where its images stand, in east, north and up.
struct Sight {
  ImageSlot a = 0;
  ImageSlot b = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit, from a to b
  uint32_t num_inliers = 0;
  double length_m = 0.0;  ///< of a step (GuessLengthsOfSteps); 0: nothing is known of it
  /// One of as many inliers as steps have in the median, less of fewer, two at most: sights of
  /// places that look alike have few.
  double weight = 1.0;
};

/// Of all directions, with lengths as all positions have them.
[[nodiscard]] std::vector<Sight> SightsOf(const ClusterProblem& problem,
                                          const PairDirections& pairs,
                                          const Eigen::Quaterniond& enu_from_world);

/// Steps are the sights of most inliers of each image, of all and of those that lead the other way:
/// to the next images on either side. They are taken to be as long as steps of the images that
/// sights join to theirs are between positions of images that count, in the median.
void GuessLengthsOfSteps(const ClusterProblem& problem,
                         const std::function<bool(ImageSlot)>& counts,
                         std::vector<Sight>& sights);

/// Which sights lie as positions do, and which positions as most of their sights do: to three
/// sigmas. Positions go out one by one, the one that the largest share of its sights contradicts
/// first, as long as that is more than half. Steps count for four times as much as other sights:
/// hardly one of them is of a place that looks alike, and how long they are is known.
class SightsBesidePositions {
 public:
  /// Both arguments must outlive this.
  SightsBesidePositions(const ClusterProblem& problem, const std::vector<Sight>& sights);

  /// Of an image with a position.
  [[nodiscard]] bool IsTrusted(ImageSlot image) const { return is_trusted_[image] != 0; }
  /// Between two positions that are trusted, or fewer.
  [[nodiscard]] bool Fits(const Sight& sight) const;

 private:
  [[nodiscard]] bool Agrees(const Sight& sight) const;
  bool DistrustTheWorst();

  const ClusterProblem& problem_;
  const std::vector<Sight>& sights_;
  std::vector<uint8_t> is_trusted_;  ///< per image of the cluster
};

}  // namespace orbweave
