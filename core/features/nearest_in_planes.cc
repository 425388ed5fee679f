// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/nearest_in_planes.h"

#include <algorithm>
#include <span>

#include "core/features/descriptor_blocks.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using internal::DescriptorBlock;
using internal::HeldJob;
using internal::LaneState;

static_assert(AxialFeatures::kRowsPerBlock == internal::kLanes);

/// Rotation that takes the axis to z.
Eigen::Quaterniond AxialFrame(const Eigen::Vector3d& axis) {
  return RotationBetween(axis, Eigen::Vector3d::UnitZ());
}

using Kernel = NearestTwo (*)(const HeldJob&);

Kernel FunctionOf([[maybe_unused]] DistanceKernel kernel) {
#if defined(__x86_64__)
  if (kernel == DistanceKernel::kAvx2) return internal::UpdateHeldAvx2;
  if (kernel == DistanceKernel::kAvx512Vnni) return internal::UpdateHeldAvx512Vnni;
#endif
  return internal::UpdateHeldPortable;
}

/// Rows lie in memory by feature, all over the place: the time it takes to fetch one is that of
/// some others.
constexpr size_t kAhead = 6;

void FetchAhead(const Features& features, std::span<const FeatureIndex> indices, size_t row) {
  if (row >= indices.size()) return;
  const uint8_t* const descriptor = features.Descriptor(indices[row]);
  __builtin_prefetch(descriptor);
  __builtin_prefetch(descriptor + kDescriptorSize / 2);
  __builtin_prefetch(descriptor + kDescriptorSize - 1);
}

/// By feature instead of row.
std::vector<NearestTwo> ByFeature(std::span<const NearestTwo> by_row,
                                  std::span<const FeatureIndex> own,
                                  std::span<const FeatureIndex> others) {
  std::vector<NearestTwo> by_feature(by_row.size());
  for (size_t row = 0; row < by_row.size(); ++row) {
    if (by_row[row].best == kNoDistance) continue;
    by_feature[own[row]] = by_row[row];
    by_feature[own[row]].index = others[by_row[row].index];
  }
  return by_feature;
}

}  // namespace

NearestInPlanes::NearestInPlanes(const PairSide& a,
                                 const PairSide& b,
                                 const Eigen::Vector3d& baseline_in_b,
                                 double max_error_rad,
                                 DistanceKernel kernel)
    : a_(a),
      axial_from_b_(AxialFrame(baseline_in_b)),
      max_error_(max_error_rad),
      kernel_(kernel),
      axial_b_(b.PlainBearings(), axial_from_b_),
      blocks_b_(internal::PackBlocks(b.features.descriptors, axial_b_.Indices())) {}

NearestTwoBothWays NearestInPlanes::Find(const Eigen::Quaterniond& b_from_a) const {
  const Kernel update_nearest = FunctionOf(kernel_);
  const AxialFeatures axial_a(a_.PlainBearings(), axial_from_b_ * b_from_a);
  std::vector<NearestTwo> of_a(axial_a.size());
  std::vector<LaneState> block_states(blocks_b_.size(), internal::EmptyState());
  std::vector<int32_t> held(blocks_b_.size() * internal::kLanes);
  for (size_t row = 0; row < axial_a.size(); ++row) {
    FetchAhead(a_.features, axial_a.Indices(), row + kAhead);
    const EpipolarWedge wedge(axial_a.At(row), max_error_);
    const FeatureIndex feature = axial_a.Indices()[row];
    for (const AxialFeatures::Blocks& near : axial_b_.BlocksNear(wedge)) {
      if (near.begin == near.end) continue;
      axial_b_.Test(wedge, near, held.data());
      const NearestTwo nearest =
          update_nearest({.row = a_.features.Descriptor(feature),
                          .row_norm = a_.squared_norms[feature],
                          .row_index = static_cast<int32_t>(row),
                          .blocks = std::span(blocks_b_).subspan(near.begin, near.end - near.begin),
                          .first_block = static_cast<int32_t>(near.begin),
                          .held = held.data(),
                          .block_states = block_states.data() + near.begin});
      of_a[row] = MergeNearest(of_a[row], nearest);
    }
  }
  return {.of_a = ByFeature(of_a, axial_a.Indices(), axial_b_.Indices()),
          .of_b = ByFeature(internal::UnpackBlocks(block_states, axial_b_.size()),
                            axial_b_.Indices(),
                            axial_a.Indices())};
}

}  // namespace orbweave
