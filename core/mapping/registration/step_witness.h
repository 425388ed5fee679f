// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// What GNSS says of how far an image stands from registered images around it. How many metres a
/// unit of the model is there is measured: over the verified pairs (a, b) among the 30 registered
/// images that pairs lead to first, the median of |G_b - G_a| / |C_b - C_a|, with positions G and
/// centres C; and how much these distances differ otherwise tells how far the stated sigmas of
/// steps are to be believed (FactorOfSteps has the same idea: errors that neighbours share cancel
/// in steps), those within a drive and those from one to another each for themselves, as drives
/// share nothing. So neither which way the model is turned matters, nor that it drifts elsewhere,
/// nor that some of its steps are wrong.
class StepWitness {
 public:
  /// Of `image`, registered or not.
  StepWitness(const MappingState& state, ImageSlot image);

  /// By how many sigmas distances from there to the nearest five of those images are not what GNSS
  /// says, the median of them. nullopt: the image has no position, or fewer than two of them have.
  [[nodiscard]] std::optional<double> Misfit(const Eigen::Vector3d& centre) const;
  [[nodiscard]] bool Contradicts(const Eigen::Vector3d& centre) const;
  [[nodiscard]] bool Supports(const Eigen::Vector3d& centre) const;
  /// The images that it rests on, the nearest first.
  [[nodiscard]] std::vector<ImageSlot> Witnesses() const;

 private:
  struct Step {
    ImageSlot image = 0;
    Eigen::Vector3d from = Eigen::Vector3d::Zero();
    double length_m = 0.0;
    double sigma_m = 0.0;
  };
  double metres_per_unit_ = 0.0;
  std::vector<Step> steps_{};
};

}  // namespace orbweave
