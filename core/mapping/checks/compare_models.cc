// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/compare_models.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <vector>

#include "core/geometry/sphere_cells.h"
#include "core/mapping/checks/borne_out_images.h"
#include "core/mapping/checks/check_against_pairs.h"
#include "core/mapping/checks/position_misfit.h"
#include "core/mapping/checks/torn_pairs.h"
#include "core/mapping/checks/uneven_images.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/measure_pair_lengths.h"

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
/// As much as a position that is wrong (PositionMisfit::Beside).
constexpr double kMisfitOfUneven = 9.0;
/// As much as those of both its images. GNSS alone liked a block that had not closed better than a
/// right one by 19: positions that are off together bend with it.
constexpr double kMisfitOfTorn = 18.0;
/// Rays contradict a right model in so many places more than one with a piece a house off.
constexpr size_t kFaultsOfUneven = 3;
constexpr size_t kFaultsOfTorn = 3;

/// What rays and pairs say of a model, and the even steps of its drives.
struct RayOpinion {
  size_t faults = 0;      ///< places where they contradict its lengths (FindLengthFaults)
  size_t uneven = 0;      ///< FindUnevenRuns and FindVanishedWays
  size_t torn = 0;        ///< FindTornPairs
  double evidence = 0.0;  ///< EvidenceFor

  [[nodiscard]] size_t Contradictions() const {
    return faults + kFaultsOfUneven * uneven + kFaultsOfTorn * torn;
  }
  /// As a squared misfit.
  [[nodiscard]] double Misfit() const {
    return kMisfitOfFault * static_cast<double>(faults) +
           kMisfitOfUneven * static_cast<double>(uneven) +
           kMisfitOfTorn * static_cast<double>(torn) - kMisfitOfEvidence * std::log(evidence);
  }
};

RayOpinion RaysOf(const MappingState& state, const MappingOptions& options) {
  return {FindLengthFaults(state, options).size(),
          FindUnevenRuns(state).size() + FindVanishedWays(state).size(),
          FindTornPairs(state, options).size(),
          EvidenceFor(state, options)};
}

/// A model that is folded as a whole may be even: steps decide nothing while models grow.
RayOpinion WithoutSteps(RayOpinion opinion) {
  opinion.uneven = 0;
  return opinion;
}

/// SpeaksMoreFor.
bool SpeaksMore(const RayOpinion& one, const RayOpinion& other) {
  if (one.Contradictions() != other.Contradictions())
    return one.Contradictions() < other.Contradictions();
  return one.evidence > other.evidence;
}

/// What GNSS and rays have to say of a model.
struct Opinion {
  double size = 0.0;
  double worth = 0.0;
  PositionMisfit misfit;
  RayOpinion rays{};
};

Opinion OpinionOf(const MappingState& state, const MappingOptions& options) {
  return {static_cast<double>(state.Registered().size()),
          BorneOutImages(state),
          PositionMisfit(state, kMatchTolerance * options.max_error_px),
          RaysOf(state, options)};
}

bool AreOfAboutTheSameImages(const Opinion& one, const Opinion& other) {
  return std::min(one.size, other.size) >= kAlike * std::max(one.size, other.size);
}

/// IsLikedByGnss.
bool IsLiked(const Opinion& one, const Opinion& other) {
  if (!AreOfAboutTheSameImages(one, other)) {
    return one.size > other.size && one.misfit.Tells() &&
           one.worth / one.size >= kAlike * other.worth / other.size &&
           one.misfit.MeanBeside(other.misfit) <=
               kNotMuchMore * (1.0 + other.misfit.MeanBeside(one.misfit));
  }
  if (one.worth > kMoreBorneOut * other.worth) return true;
  if (kMoreBorneOut * one.worth < other.worth) return false;
  return one.misfit.Tells() && other.misfit.Tells() &&
         one.misfit.Beside(other.misfit) + one.rays.Misfit() <
             other.misfit.Beside(one.misfit) + other.rays.Misfit() &&
         one.rays.evidence >= kHardlyLess * other.rays.evidence;
}

}  // namespace

bool IsContested(const MappingState& state, const MappingOptions& options) {
  return CheckAgainstPairs(state, options).agreeing_share < kAtOne ||
         std::ranges::any_of(FindLengthFaults(state, options), [](const LengthFault& fault) {
           return fault.kind != LengthFaultKind::kWall;
         });
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
  return SpeaksMore(WithoutSteps(RaysOf(one, options)), WithoutSteps(RaysOf(other, options)));
}

bool RaysAndStepsSpeakMoreFor(const MappingState& one,
                              const MappingState& other,
                              const MappingOptions& options) {
  return SpeaksMore(RaysOf(one, options), RaysOf(other, options));
}

bool IsLikedByGnss(const MappingState& one,
                   const MappingState& other,
                   const MappingOptions& options) {
  return IsLiked(OpinionOf(one, options), OpinionOf(other, options));
}

bool IsBetterModel(const MappingState& one,
                   const MappingState& other,
                   const MappingOptions& options) {
  const Opinion of_one = OpinionOf(one, options);
  const Opinion of_other = OpinionOf(other, options);
  if (of_one.worth > kClearly * of_other.worth) return true;
  if (kClearly * of_one.worth < of_other.worth) return false;
  if (IsLiked(of_one, of_other)) return true;
  if (IsLiked(of_other, of_one)) return false;
  return SpeaksMore(WithoutSteps(of_one.rays), WithoutSteps(of_other.rays));
}

}  // namespace orbweave
