// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// Baseline of an edge over the depth of what it sees, 2 tan(median angle / 2); 0 for a pure
/// rotation, at most 3: beyond, the angle says little.
[[nodiscard]] double BaselineOverDepth(const ViewEdge& edge);

/// The way of a drive as its neighbours in the sequence tell it, without a common scale: each step
/// has a direction and a length in depths of what is seen there.
class DriveChain {
 public:
  /// A half-space of directions in steps of 45 degrees or so; the other half by sign.
  static constexpr size_t kAxes = 13;
  [[nodiscard]] static const std::array<Eigen::Vector3d, kAxes>& Axes();

  /// What lies between two images of one unbroken stretch, in the frame of the stretch.
  struct Way {
    ImageId first{};
    uint32_t steps = 0;
    double length = 0.0;                                ///< sum over steps, in depths
    std::array<double, kAxes> forward{};                ///< along each axis: what goes forward
    std::array<double, kAxes> backward{};               ///< and what goes back, both >= 0
    Eigen::Quaterniond last_from_first{1, 0, 0, 0};     ///< rotation
    Eigen::Quaterniond stretch_from_first{1, 0, 0, 0};  ///< rotation
  };

  /// Images of a drive follow each other as in SequenceOfDrives. A step is the strongest edge to
  /// the next image, or one of the three after it, that closes triangles in rotation with others
  /// around and leaves no more of them open, each as heavy as the weaker of its other edges has
  /// inliers. Elsewhere, and where too many are missing (IsInSequence), a stretch ends: what
  /// nothing confirms predicts nothing.
  DriveChain(const std::vector<ViewEdge>& edges, const ImageManifest& manifest);

  /// The way from the image that the drive comes to first, whichever it is, to the other; nullopt
  /// where no unbroken stretch holds both.
  [[nodiscard]] std::optional<Way> Between(ImageId a, ImageId b) const;

  /// Whether an edge, true to its length, may join images far apart in depths of what neighbours
  /// see: edges of one of its images reach every image of the drive between the two but single
  /// ones, and this edge has at most twice the inliers of the weakest of them. What is seen from
  /// ever farther is ever less; a place that looks alike is seen as if from near.
  [[nodiscard]] bool MaySeeFar(const ViewEdge& edge) const;

 private:
  struct Place {
    uint32_t stretch = 0;  ///< 0: none
    uint32_t step = 0;
    double length = 0.0;
    std::array<double, kAxes> forward{};
    std::array<double, kAxes> backward{};
    Eigen::Quaterniond stretch_from_cam{1, 0, 0, 0};
  };

  /// Images of the drive that edges of one image reach, nearest first, up to the first two in a row
  /// that they do not: each with the inliers of the weakest edge so far.
  using Sight = std::vector<std::pair<uint32_t, uint32_t>>;

  void Append(ImageId from, ImageId to, const Rigid3& next_from_cam, double length);
  [[nodiscard]] static bool IsInSight(const Sight& sight, uint32_t image, uint32_t num_inliers);

  std::vector<Place> places_;
  std::vector<Sight> ahead_;
  std::vector<Sight> behind_;
};

}  // namespace orbweave
