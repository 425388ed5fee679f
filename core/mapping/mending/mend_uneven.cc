// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/mend_uneven.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/mapping/adjustment/adjust_global.h"
#include "core/mapping/checks/compare_models.h"
#include "core/mapping/checks/uneven_images.h"
#include "core/mapping/lengths/line_pieces.h"
#include "core/mapping/lengths/measure_pair_lengths.h"
#include "core/mapping/model/move_images.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// Each adjusts everything.
constexpr size_t kMaxTries = 6;
/// Those that stand off by as much of what the worst does moved with it.
constexpr double kAlike = 0.5;
/// About the even place, in steps: what steps vary by.
constexpr std::array kAboutPlace = {0.0, -0.07, 0.07, -0.14, 0.14};

/// How far each image of a run is from its even place on the way between its ends.
std::vector<Vector3d> ToEvenPlaces(const MappingState& state, const UnevenRun& run) {
  const auto rank = [&](ImageSlot image) {
    return static_cast<double>(state.Problem().images[image].rank_in_drive);
  };
  const ImageSlot first = run.images.front();
  const ImageSlot last = run.images.back();
  std::vector<Vector3d> way;
  for (const ImageSlot image : run.images) {
    const double share = (rank(image) - rank(first)) / (rank(last) - rank(first));
    const Vector3d even = state.Centre(first) + share * (state.Centre(last) - state.Centre(first));
    way.push_back(even - state.Centre(image));
  }
  return way;
}

/// Images of a run that stand off alike, and by how much to move them.
struct Block {
  std::vector<ImageSlot> images{};
  Vector3d by = Vector3d::Zero();
  Vector3d step = Vector3d::Zero();  ///< along the way
};

Block BlockOf(const MappingState& state, const UnevenRun& run) {
  const Vector3d along =
      (state.Centre(run.images.back()) - state.Centre(run.images.front())).normalized();
  const std::vector<Vector3d> to_even = ToEvenPlaces(state, run);
  const Vector3d& worst = to_even[run.uneven.stop];
  const auto is_alike = [&](size_t i) {
    return to_even[i].dot(worst) >= kAlike * worst.squaredNorm();
  };
  size_t first = run.uneven.stop;
  size_t last = run.uneven.stop;
  while (is_alike(first - 1)) --first;  // the ends of the run stand at their places
  while (is_alike(last + 1)) ++last;
  Block block;
  for (size_t i = first; i <= last; ++i) {
    block.images.push_back(run.images[i]);
    block.by += to_even[i] / static_cast<double>(last - first + 1);
  }
  // Along the way, but for one that was flung off it.
  if (run.uneven.share < 1.0) block.by = block.by.dot(along) * along;
  block.step = run.uneven.step * along;
  return block;
}

CandidateMove BestMove(MappingState& state, const Block& block, const MappingOptions& options) {
  CandidateMove best;
  std::optional<double> most;
  for (const double about : kAboutPlace) {
    CandidateMove move = Shifted(state, block.images, block.by + about * block.step);
    const CandidateMove back = PosesNow(state, move);
    PutAt(state, move);
    const double agreeing = CountAgreeingRays(state, options);
    PutAt(state, back);
    if (most && agreeing <= *most) continue;
    most = agreeing;
    best = std::move(move);
  }
  return best;
}

/// All behind a step, to be moved as far as it is short.
Block BlockBehind(const MappingState& state, const VanishedWay& way, const LinePieces& pieces) {
  const Vector3d sense = way.share < 0.0 ? state.Centre(way.image) - state.Centre(way.next)
                                         : state.Centre(way.next) - state.Centre(way.image);
  const Vector3d step = way.step * sense.normalized();
  return {.images = pieces.From(way.next), .by = (1.0 - way.share) * step, .step = step};
}

bool IsMended(const MappingState& mended,
              const MappingState& before,
              const MappingOptions& options) {
  if (IsLikedByGnss(mended, before, options)) return true;
  return !IsLikedByGnss(before, mended, options) &&
         RaysAndStepsSpeakMoreFor(mended, before, options);
}

/// Moves a block, and everything as that has it, if that is better.
absl::StatusOr<bool> TryMove(const Block& block,
                             const MappingOptions& options,
                             const StageContext& context,
                             MappingState& state) {
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  MappingState mended = state;
  PutAt(mended, BestMove(mended, block, options));
  RemakePoints(mended, state, options);
  ORBWEAVE_RETURN_IF_ERROR(AdjustGrowingModel(mended, options, context));
  const bool is_mended = IsMended(mended, state, options);
  if (is_mended) state = std::move(mended);
  return is_mended;
}

absl::StatusOr<bool> MendRuns(MappingState& state,
                              const MappingOptions& options,
                              const StageContext& context) {
  std::vector<UnevenRun> runs = FindUnevenRuns(state);
  std::ranges::stable_sort(
      runs, std::greater<>(), [](const UnevenRun& run) { return run.uneven.off_steps; });
  runs.resize(std::min(runs.size(), kMaxTries));
  bool has_moved = false;
  for (const UnevenRun& run : runs) {
    const bool is_whole =
        std::ranges::all_of(run.images, [&](ImageSlot image) { return state.IsRegistered(image); });
    if (!is_whole) continue;
    ORBWEAVE_ASSIGN_OR_RETURN(const bool is_mended,
                              TryMove(BlockOf(state, run), options, context, state));
    has_moved = has_moved || is_mended;
  }
  return has_moved;
}

absl::StatusOr<bool> MendVanished(MappingState& state,
                                  const MappingOptions& options,
                                  const StageContext& context) {
  std::vector<VanishedWay> ways = FindVanishedWays(state);
  std::ranges::stable_sort(ways, {}, &VanishedWay::share);
  ways.resize(std::min(ways.size(), kMaxTries));
  bool has_moved = false;
  for (const VanishedWay& way : ways) {
    if (!state.IsRegistered(way.image) || !state.IsRegistered(way.next)) continue;
    const LinePieces pieces(state, options);
    if (!pieces.AreOfOneLine(way.image, way.next)) continue;
    ORBWEAVE_ASSIGN_OR_RETURN(const bool is_mended,
                              TryMove(BlockBehind(state, way, pieces), options, context, state));
    has_moved = has_moved || is_mended;
  }
  return has_moved;
}

}  // namespace

absl::StatusOr<bool> MendUneven(MappingState& state,
                                const MappingOptions& options,
                                const StageContext& context) {
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  ORBWEAVE_ASSIGN_OR_RETURN(const bool has_moved, MendRuns(state, options, context));
  ORBWEAVE_ASSIGN_OR_RETURN(const bool has_stretched, MendVanished(state, options, context));
  return has_moved || has_stretched;
}

}  // namespace orbweave
