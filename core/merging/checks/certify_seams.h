// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/merging/checks/place_by_sides.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// How well the two sides of a seam agree after the global adjustment. An image of the overlap is
/// placed twice, by the points that panoramas of one side see, and by those of the other, all other
/// things as adjusted: where the sides pull it apart, the seam does not fit. World units.
struct SeamCertificate {
  uint32_t cluster_a = 0;
  uint32_t cluster_b = 0;
  uint32_t num_images = 0;         ///< that both sides can place
  double position_jump_m = 0.0;    ///< rms distance of the two places
  double rotation_jump_deg = 0.0;  ///< rms angle between the two rotations
  /// What bearings alone would leave on average (one standard deviation, all axes together).
  double position_noise_m = 0.0;
  double rotation_noise_deg = 0.0;
};

/// Certifies the seams of one adjusted world from its subproblems' placements; memory grows with
/// the overlaps.
class SeamCertifier {
 public:
  /// Seams of which one side is not among the world's `clusters` are left out.
  SeamCertifier(const std::vector<Seam>& seams, const std::set<uint32_t>& clusters);

  /// In order of the subproblems.
  void Add(std::span<const SidePlacement> placements);

  /// In order of the seams. `bearing_factor`: a-posteriori over claimed variance of bearings.
  [[nodiscard]] std::vector<SeamCertificate> Finish(double bearing_factor) const;

 private:
  void AddSeam(const Seam& seam, double bearing_factor, std::vector<SeamCertificate>& out) const;

  std::vector<Seam> seams_;
  /// Of shared images, by the cluster whose panoramas see the points.
  std::map<std::pair<ImageId, uint32_t>, SidePlacement> placements_;
};

}  // namespace orbweave
