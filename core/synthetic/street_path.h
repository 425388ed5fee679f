// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace orbweave {

/// A place on a path: position in east-north metres and the unit direction of travel there.
struct PathPlace {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();

  /// Unit vector to the left of the direction of travel.
  [[nodiscard]] Eigen::Vector2d Left() const { return {-direction.y(), direction.x()}; }
};

/// The axis of a street: a polyline whose corners are rounded, walked by arc length.
class StreetPath {
 public:
  /// At least two different corners; `closed` joins the last to the first. The radius is reduced
  /// where a side is too short for it.
  StreetPath(const std::vector<Eigen::Vector2d>& corners, double radius_m, bool closed);

  [[nodiscard]] double length_m() const { return stations_m_.back(); }
  [[nodiscard]] bool closed() const { return closed_; }
  /// Place at arc length `station_m`: modulo the length when closed, else extended straight.
  [[nodiscard]] PathPlace At(double station_m) const;

 private:
  void Append(const Eigen::Vector2d& vertex);

  std::vector<Eigen::Vector2d> vertices_{};
  std::vector<double> stations_m_{};  // arc length at each vertex
  bool closed_;
};

}  // namespace orbweave
