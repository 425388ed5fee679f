// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace orbweave {

/// Rays' word for how long one pair is, and where its geometry has it lead.
class ToldLengths {
 public:
  /// `direction`: unit, in the world; `log_lengths`: logarithms of lengths, a ray each, any order.
  ToldLengths(const Eigen::Vector3d& direction, std::vector<double> log_lengths);

  [[nodiscard]] const Eigen::Vector3d& Direction() const { return direction_; }
  /// How many agree closely (kCloseTolerance) with a step that leads where the pair does; 50 of a
  /// pair at most: one that tracks fooled has many rays, what counts is how many pairs say the
  /// same.
  [[nodiscard]] double CountAgreeing(const Eigen::Vector3d& step) const;
  /// Lengths that most say, two at most: the middle of the closely agreeing interval that holds
  /// most, and the same of what is left without it.
  [[nodiscard]] std::vector<double> Modes() const;
  /// So many or fewer agree closely with any one length between two (CountAgreeing).
  [[nodiscard]] double MostWithin(double shortest, double longest) const;
  /// The length between two that most say; nullopt where none does.
  [[nodiscard]] std::optional<double> ModeWithin(double shortest, double longest) const;
  /// Those that agree closely with a length, ascending. Refers to this.
  [[nodiscard]] std::span<const double> Near(double length) const;

 private:
  /// The weight of one ray, 50 of the pair at most.
  [[nodiscard]] double WeightOfRay() const;

  Eigen::Vector3d direction_;
  std::vector<double> log_lengths_;  ///< ascending
  std::vector<double> lengths_{};    ///< the same
};

}  // namespace orbweave
