// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/slide_onto_gnss.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "core/mapping/adjustment/adjust_global.h"
#include "core/mapping/checks/compare_models.h"
#include "core/mapping/lengths/gnss_ways.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/measure_pair_lengths.h"
#include "core/mapping/mending/list_slides.h"

namespace orbweave {
namespace {

constexpr int kMaxTries = 8;
constexpr double kClearlyLess = 9.0;
/// Only which slide is tried first depends on it: three sigmas weigh as much as most of the rays
/// that one pair counts with.
constexpr double kRaysPerSquare = 20.0;

/// A slide, and what speaks for it: agreeing rays, and what GNSS minds less.
struct Prospect {
  CandidateMove move{};
  double worth = 0.0;
};

/// Slides that GNSS clearly likes better, the most promising first.
std::vector<Prospect> ListProspects(MappingState& state,
                                    const MappingOptions& options,
                                    const GnssWays& gnss) {
  const double misfit_now = gnss.Misfit(state);
  std::vector<Prospect> prospects;
  for (CandidateMove& move : ListSlides(state, options, gnss)) {
    const CandidateMove back = PosesNow(state, move);
    PutAt(state, move);
    const double misfit = gnss.Misfit(state);
    const bool is_liked = misfit <= misfit_now - kClearlyLess;
    const double rays = is_liked ? CountAgreeingRays(state, options) : 0.0;
    PutAt(state, back);
    if (!is_liked) continue;
    prospects.push_back({std::move(move), kRaysPerSquare * (misfit_now - misfit) + rays});
  }
  std::ranges::stable_sort(prospects, std::greater<>(), &Prospect::worth);
  return prospects;
}

/// What speaks for and against the model before a slide.
struct Standing {
  double misfit = 0.0;
  size_t faults = 0;
  size_t places = 0;
};

/// Whether GNSS likes a model clearly better with the slide made, and what points hold speaks not
/// against it: rays contradict it in fewer places, or as many places hold as before; where rays
/// contradict it in more, only if most of what GNSS minds at its edges is gone.
bool IsBetter(const MappingState& moved,
              const MappingState& before,
              const Standing& standing,
              const CandidateMove& slide,
              const GnssWays& gnss,
              const MappingOptions& options) {
  if (moved.Registered().size() < before.Registered().size() ||
      gnss.Misfit(moved) > standing.misfit - kClearlyLess)
    return false;
  const size_t faults = FindLengthFaults(moved, options).size();
  if (faults < standing.faults) return true;
  const bool is_settled =
      2.0 * gnss.MisfitAtEdges(moved, slide) <= gnss.MisfitAtEdges(before, slide);
  return CountHeldPlaces(moved) >= standing.places && (faults == standing.faults || is_settled);
}

/// The model with a slide made and everything adjusted, if that is better.
absl::StatusOr<bool> TrySlide(const CandidateMove& slide,
                              const Standing& standing,
                              const GnssWays& gnss,
                              const MappingOptions& options,
                              const StageContext& context,
                              MappingState& state) {
  MappingState moved = state;
  PutAt(moved, slide);
  RemakePoints(moved, state, options);
  ORBWEAVE_RETURN_IF_ERROR(AdjustGrowingModel(moved, options, context));
  const bool is_better = IsBetter(moved, state, standing, slide, gnss, options);
  if (is_better) state = std::move(moved);
  return is_better;
}

/// Whether one of the most promising slides was made.
absl::StatusOr<bool> MakeOneSlide(const GnssWays& gnss,
                                  const MappingOptions& options,
                                  const StageContext& context,
                                  int& tries_left,
                                  MappingState& state) {
  const std::vector<Prospect> prospects = ListProspects(state, options, gnss);
  if (prospects.empty()) return false;
  const Standing standing{.misfit = gnss.Misfit(state),
                          .faults = FindLengthFaults(state, options).size(),
                          .places = CountHeldPlaces(state)};
  for (const Prospect& prospect : prospects) {
    if (tries_left-- <= 0) break;
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    ORBWEAVE_ASSIGN_OR_RETURN(const bool is_better,
                              TrySlide(prospect.move, standing, gnss, options, context, state));
    if (is_better) return true;
  }
  return false;
}

}  // namespace

absl::StatusOr<bool> SlideOntoGnss(MappingState& state,
                                   const MappingOptions& options,
                                   const StageContext& context) {
  int tries_left = kMaxTries;
  bool has_slid = false;
  while (tries_left > 0) {
    const GnssWays gnss(state, kMatchTolerance * options.max_error_px);
    if (gnss.Ways().empty()) break;
    ORBWEAVE_ASSIGN_OR_RETURN(const bool has_improved,
                              MakeOneSlide(gnss, options, context, tries_left, state));
    if (!has_improved) break;
    has_slid = true;
  }
  return has_slid;
}

}  // namespace orbweave
