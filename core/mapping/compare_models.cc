// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/compare_models.h"

#include <bitset>
#include <vector>

#include "core/geometry/sphere_cells.h"
#include "core/mapping/borne_out_images.h"
#include "core/mapping/check_against_pairs.h"
#include "core/mapping/measure_pair_lengths.h"

namespace orbweave {
namespace {

constexpr double kAtOne = 0.97;
constexpr size_t kManyObservations = 4;
constexpr double kClearly = 1.5;

}  // namespace

bool IsContested(const MappingState& state, const MappingOptions& options) {
  return CheckAgainstPairs(state, options).agreeing_share < kAtOne ||
         !FindLengthFaults(state, options).empty();
}

size_t CountHeldPlaces(const MappingState& state) {
  using Places = std::bitset<static_cast<size_t>(kSpreadCells) * kSpreadCells>;
  std::vector<Places> places(state.Graph().NumImages());
  for (PointIndex point = 0; point < state.EndOfPoints(); ++point) {
    const std::vector<Node>& nodes = state.Point(point).nodes;
    if (nodes.size() < kManyObservations) continue;
    for (const Node node : nodes) {
      const uint32_t cell = SphereCell(state.Graph().bearing_of_node[node], kSpreadCells);
      places[state.Graph().image_of_node[node]].set(cell);
    }
  }
  size_t count = 0;
  for (const Places& of_image : places) count += of_image.count();
  return count;
}

double EvidenceFor(const MappingState& state, const MappingOptions& options) {
  return (1.0 + CountAgreeingRays(state, options)) *
         (1.0 + static_cast<double>(CountHeldPlaces(state)));
}

bool SpeaksMoreFor(const MappingState& one,
                   const MappingState& other,
                   const MappingOptions& options) {
  const size_t faults = FindLengthFaults(one, options).size();
  const size_t faults_of_other = FindLengthFaults(other, options).size();
  if (faults != faults_of_other) return faults < faults_of_other;
  return EvidenceFor(one, options) > EvidenceFor(other, options);
}

bool IsBetterModel(const MappingState& one,
                   const MappingState& other,
                   const MappingOptions& options) {
  const double worth = BorneOutImages(one);
  const double worth_of_other = BorneOutImages(other);
  if (worth > kClearly * worth_of_other) return true;
  if (kClearly * worth < worth_of_other) return false;
  return SpeaksMoreFor(one, other, options);
}

}  // namespace orbweave
