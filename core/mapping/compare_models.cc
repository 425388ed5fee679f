// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/compare_models.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <vector>

#include "core/geometry/sphere_cells.h"
#include "core/mapping/borne_out_images.h"
#include "core/mapping/check_against_pairs.h"
#include "core/mapping/matches_in_planes.h"
#include "core/mapping/measure_pair_lengths.h"
#include "core/mapping/position_misfit.h"

namespace orbweave {
namespace {

constexpr double kAtOne = 0.97;
constexpr size_t kManyObservations = 4;
constexpr double kClearly = 1.5;
constexpr double kMoreBorneOut = 1.25;
constexpr double kAlike = 0.95;
constexpr double kHardlyLess = 0.8;
constexpr double kNotMuchMore = 1.5;
/// Of ten models each of six streets with houses that repeat, the one that these, and the misfit of
/// positions, have as the best was the best or 0.4 m worse.
constexpr double kMisfitOfFault = 1.5;
constexpr double kMisfitOfEvidence = 20.0;

/// What GNSS has to say of a model.
struct GnssOpinion {
  const MappingState& state;
  double worth = 0.0;
  PositionMisfit misfit;

  [[nodiscard]] double Size() const { return static_cast<double>(state.Registered().size()); }
};

GnssOpinion OpinionOf(const MappingState& state, const MappingOptions& options) {
  return {
      state, BorneOutImages(state), PositionMisfit(state, kMatchTolerance * options.max_error_px)};
}

bool AreOfAboutTheSameImages(const GnssOpinion& one, const GnssOpinion& other) {
  return std::min(one.Size(), other.Size()) >= kAlike * std::max(one.Size(), other.Size());
}

/// What rays have against a model, as a squared misfit.
double MisfitOfRays(const MappingState& state, const MappingOptions& options) {
  return kMisfitOfFault * static_cast<double>(FindLengthFaults(state, options).size()) -
         kMisfitOfEvidence * std::log(EvidenceFor(state, options));
}

/// By how much the one is more at odds with its positions, and with these and its rays together.
struct MisfitBeyond {
  double of_positions = 0.0;
  double of_all = 0.0;
};

MisfitBeyond Compare(const GnssOpinion& one,
                     const GnssOpinion& other,
                     const MappingOptions& options) {
  const double of_positions = one.misfit.Beside(other.misfit) - other.misfit.Beside(one.misfit);
  return {of_positions,
          of_positions + MisfitOfRays(one.state, options) - MisfitOfRays(other.state, options)};
}

/// IsLikedByGnss.
bool IsLiked(const GnssOpinion& one, const GnssOpinion& other, const MappingOptions& options) {
  if (!AreOfAboutTheSameImages(one, other)) {
    return one.Size() > other.Size() && one.misfit.Tells() &&
           one.worth / one.Size() >= kAlike * other.worth / other.Size() &&
           one.misfit.MeanBeside(other.misfit) <=
               kNotMuchMore * (1.0 + other.misfit.MeanBeside(one.misfit));
  }
  if (one.worth > kMoreBorneOut * other.worth) return true;
  if (kMoreBorneOut * one.worth < other.worth) return false;
  const MisfitBeyond beyond = Compare(one, other, options);
  return beyond.of_positions < 0.0 && beyond.of_all < 0.0 &&
         EvidenceFor(one.state, options) >= kHardlyLess * EvidenceFor(other.state, options);
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
  return IsLiked(OpinionOf(one, options), OpinionOf(other, options), options);
}

bool IsBetterModel(const MappingState& one,
                   const MappingState& other,
                   const MappingOptions& options) {
  const GnssOpinion of_one = OpinionOf(one, options);
  const GnssOpinion of_other = OpinionOf(other, options);
  if (of_one.worth > kClearly * of_other.worth) return true;
  if (kClearly * of_one.worth < of_other.worth) return false;
  if (IsLiked(of_one, of_other, options)) return true;
  if (IsLiked(of_other, of_one, options)) return false;
  return SpeaksMoreFor(one, other, options);
}

}  // namespace orbweave
