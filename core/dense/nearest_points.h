// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace orbweave {

/// Distances to the nearest of many points, as far as a limit: cubes of that size in a hash table,
/// each divided into 8 x 8 x 8, whose boxes are skipped when they are farther than what is known.
/// Built in linear time, 40 bytes a point; a question costs the same however many points there are.
/// Points that are not finite are left out.
class NearestPoints {
 public:
  NearestPoints(std::span<const Eigen::Vector3d> points, double limit);

  /// Distance to the nearest point; infinity when none is nearer than the limit, and for a question
  /// that is not finite.
  [[nodiscard]] double DistanceTo(const Eigen::Vector3d& point) const;
  [[nodiscard]] size_t size() const { return points_.size(); }

 private:
  using Cube = std::array<int64_t, 3>;
  struct CubeHash {
    size_t operator()(const Cube& cube) const;
  };
  /// Points [begin, begin of the next) of one of the 512 parts of a cube.
  struct Part {
    uint16_t place = 0;
    size_t begin = 0;
  };
  struct Parts {
    size_t begin = 0;
    size_t end = 0;
  };

  [[nodiscard]] Cube CubeOf(const Eigen::Vector3d& point) const;
  [[nodiscard]] uint16_t PlaceOf(const Eigen::Vector3d& point, const Cube& cube) const;
  /// The lesser of `best` (squared) and the squared distance to the points of a cube.
  [[nodiscard]] double Search(const Eigen::Vector3d& point, const Cube& cube, double best) const;
  void Divide(std::vector<Eigen::Vector3d>& cube_points, const Cube& cube);

  double limit_;
  std::vector<Eigen::Vector3d> points_{};  ///< cube by cube, part by part
  std::vector<Part> parts_{};              ///< one more at the end
  std::unordered_map<Cube, Parts, CubeHash> cubes_{};
};

}  // namespace orbweave
