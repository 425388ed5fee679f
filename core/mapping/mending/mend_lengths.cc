// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/mend_lengths.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/mapping/adjustment/adjust_global.h"
#include "core/mapping/checks/compare_models.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/measure_pair_lengths.h"
#include "core/mapping/mending/candidate_moves.h"
#include "core/mapping/model/move_images.h"
#include "core/mapping/registration/step_witness.h"

namespace orbweave {
namespace {

constexpr int kMaxMoves = 12;
/// Each asks all rays of the cluster: a street that is wrong everywhere is not worth more.
constexpr int kMaxTries = 150;

/// Whether GNSS speaks against where an image would stand that has others beside it that stay.
bool IsAgainstGnss(const MappingState& state, const CandidateMove& move) {
  return std::ranges::any_of(move, [&](const auto& entry) {
    const StepWitness witness(state, entry.first);
    const std::vector<ImageSlot> witnesses = witness.Witnesses();
    const bool is_at_edge =
        std::ranges::any_of(witnesses, [&](ImageSlot other) { return !move.contains(other); });
    return is_at_edge && witness.Contradicts(entry.second.Centre());
  });
}

/// A kind of moves, and what is to become more.
struct Remedy {
  std::vector<CandidateMove> (*list)(const MappingState&, const MappingOptions&);
  double (*count)(const MappingState&, const MappingOptions&);
};

/// First the sides of ways are turned to each other as matches have it, then lengths are mended.
constexpr std::array<Remedy, 2> kRemedies = {
    {{ListTurns,
      [](const MappingState& state, const MappingOptions& options) {
        return CountMatchesInPlanes(state, kMatchTolerance * options.max_error_px);
      }},
     {ListShifts, CountAgreeingRays}}};

/// Makes the one move with which most agrees, if more does than now. Poses alone are moved.
bool MakeBestMove(const Remedy& remedy,
                  const MappingOptions& options,
                  int& tries_left,
                  MappingState& state) {
  double most = remedy.count(state, options);
  std::optional<CandidateMove> best;
  for (const CandidateMove& move : remedy.list(state, options)) {
    if (tries_left-- <= 0) break;
    const CandidateMove back = PosesNow(state, move);
    PutAt(state, move);
    const double agreeing = remedy.count(state, options);
    PutAt(state, back);
    if (agreeing <= most || IsAgainstGnss(state, move)) continue;
    most = agreeing;
    best = move;
  }
  if (best) PutAt(state, *best);
  return best.has_value();
}

/// How many moves were made.
absl::StatusOr<int> MakeMoves(const MappingOptions& options,
                              const StageContext& context,
                              MappingState& state) {
  int num_moves = 0;
  int tries_left = kMaxTries;
  for (const Remedy& remedy : kRemedies) {
    for (int i = 0; i < kMaxMoves && MakeBestMove(remedy, options, tries_left, state); ++i) {
      ++num_moves;
      ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    }
  }
  return num_moves;
}

}  // namespace

absl::StatusOr<bool> MendLengths(MappingState& state,
                                 const MappingOptions& options,
                                 const StageContext& context) {
  if (FindLengthFaults(state, options).empty()) return false;
  MappingState mended = state;
  ORBWEAVE_ASSIGN_OR_RETURN(const int num_moves, MakeMoves(options, context, mended));
  if (num_moves == 0) return false;
  RemakePoints(mended, state, options);
  ORBWEAVE_RETURN_IF_ERROR(AdjustGrowingModel(mended, options, context));
  if (!SpeaksMoreFor(mended, state, options)) return false;
  state = std::move(mended);
  return true;
}

}  // namespace orbweave
