// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/nearest_in_planes.h"

#include <algorithm>

#include "core/features/descriptor_distance.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

/// Rotation that takes the axis to z.
Eigen::Quaterniond AxialFrame(const Eigen::Vector3d& axis) {
  return RotationBetween(axis, Eigen::Vector3d::UnitZ());
}

void Update(NearestTwo& nearest, int32_t distance, FeatureIndex index) {
  if (distance < nearest.best || (distance == nearest.best && index < nearest.index)) {
    nearest.second = nearest.best;
    nearest.best = distance;
    nearest.index = index;
  } else {
    nearest.second = std::min(nearest.second, distance);
  }
}

}  // namespace

NearestInPlanes::NearestInPlanes(const PairSide& a,
                                 const PairSide& b,
                                 const Eigen::Vector3d& baseline_in_b,
                                 double max_error_rad)
    : a_(a),
      axial_from_b_(AxialFrame(baseline_in_b)),
      max_error_rad_(max_error_rad),
      axial_b_(b.bearings, axial_from_b_) {
  descriptors_b_.reserve(b.features.descriptors.size());
  for (size_t row = 0; row < axial_b_.size(); ++row) {
    const uint8_t* const descriptor = b.features.Descriptor(axial_b_.IndexOf(row));
    descriptors_b_.insert(descriptors_b_.end(), descriptor, descriptor + kDescriptorSize);
  }
}

NearestTwoBothWays NearestInPlanes::Find(const Eigen::Quaterniond& b_from_a) const {
  const AxialFeatures axial_a(a_.bearings, axial_from_b_ * b_from_a);
  NearestTwoBothWays nearest{.of_a = std::vector<NearestTwo>(axial_a.size()),
                             .of_b = std::vector<NearestTwo>(axial_b_.size())};
  std::vector<uint32_t> rows;
  std::vector<int32_t> distances;
  for (size_t row_a = 0; row_a < axial_a.size(); ++row_a) {
    const FeatureIndex of_a = axial_a.IndexOf(row_a);
    axial_b_.Within(EpipolarWedge(axial_a.At(row_a), max_error_rad_), rows);
    distances.resize(rows.size());
    SquaredDistances(a_.features.Descriptor(of_a), descriptors_b_.data(), rows, distances.data());
    for (size_t k = 0; k < rows.size(); ++k) {
      const FeatureIndex of_b = axial_b_.IndexOf(rows[k]);
      Update(nearest.of_a[of_a], distances[k], of_b);
      Update(nearest.of_b[of_b], distances[k], of_a);
    }
  }
  return nearest;
}

}  // namespace orbweave
