// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/compare_models.h"

#include <algorithm>
#include <bitset>
#include <vector>

#include "core/geometry/sphere_cells.h"
#include "core/mapping/borne_out_images.h"
#include "core/mapping/check_against_pairs.h"
#include "core/mapping/gnss_ways.h"
#include "core/mapping/matches_in_planes.h"
#include "core/mapping/measure_pair_lengths.h"

namespace orbweave {
namespace {

constexpr double kAtOne = 0.97;
constexpr size_t kManyObservations = 4;
constexpr double kClearly = 1.5;
constexpr double kMoreBorneOut = 1.25;
constexpr double kClearMisfit = 30.0;
constexpr double kSameImages = 0.95;
constexpr double kHardlyLess = 0.8;
constexpr double kNotMuchMore = 1.5;

double MeanMisfit(const GnssWays& ways, const MappingState& state) {
  return ways.Misfit(state) / static_cast<double>(std::max<size_t>(ways.Ways().size(), 1));
}

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

bool IsLikedByGnss(const MappingState& one,
                   const MappingState& other,
                   const MappingOptions& options) {
  const auto size = static_cast<double>(one.Registered().size());
  const auto size_of_other = static_cast<double>(other.Registered().size());
  const double worth = BorneOutImages(one);
  const double worth_of_other = BorneOutImages(other);
  const double tolerance_px = kMatchTolerance * options.max_error_px;
  const GnssWays ways(one, tolerance_px);
  const GnssWays ways_of_other(other, tolerance_px);
  if (std::min(size, size_of_other) < kSameImages * std::max(size, size_of_other)) {
    return size > size_of_other && !ways.Ways().empty() &&
           worth / size >= kSameImages * worth_of_other / size_of_other &&
           MeanMisfit(ways, one) <= kNotMuchMore * (1.0 + MeanMisfit(ways_of_other, other));
  }
  if (worth > kMoreBorneOut * worth_of_other) return true;
  if (kMoreBorneOut * worth < worth_of_other) return false;
  return ways.MisfitBeside(ways_of_other, one) + kClearMisfit <=
             ways_of_other.MisfitBeside(ways, other) &&
         EvidenceFor(one, options) >= kHardlyLess * EvidenceFor(other, options);
}

bool IsBetterModel(const MappingState& one,
                   const MappingState& other,
                   const MappingOptions& options) {
  const double worth = BorneOutImages(one);
  const double worth_of_other = BorneOutImages(other);
  if (worth > kClearly * worth_of_other) return true;
  if (kClearly * worth < worth_of_other) return false;
  if (IsLikedByGnss(one, other, options)) return true;
  if (IsLikedByGnss(other, one, options)) return false;
  return SpeaksMoreFor(one, other, options);
}

}  // namespace orbweave
