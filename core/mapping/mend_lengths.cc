// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mend_lengths.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/mapping/adjust_global.h"
#include "core/mapping/candidate_moves.h"
#include "core/mapping/compare_models.h"
#include "core/mapping/filter_points.h"
#include "core/mapping/mapping_schedule.h"
#include "core/mapping/measure_pair_lengths.h"
#include "core/mapping/step_witness.h"
#include "core/mapping/triangulate_tracks.h"

namespace orbweave {
namespace {

constexpr int kMaxMoves = 12;
/// Centres told by rays are right to some hundredths of a step, points to less than a pixel.
constexpr double kSlack = 3.0;

void PutAt(MappingState& state, const CandidateMove& move) {
  for (const auto& [image, centre] : move)
    state.SetPose(image, Rigid3::FromCentre(state.CamFromWorld(image).rotation, centre));
}

CandidateMove CentresNow(const MappingState& state, const CandidateMove& of) {
  CandidateMove centres;
  for (const auto& [image, centre] : of) centres[image] = state.Centre(image);
  return centres;
}

/// Whether GNSS speaks against where an image would stand that has others beside it that stay.
bool IsAgainstGnss(const MappingState& state, const CandidateMove& move) {
  return std::ranges::any_of(move, [&](const auto& entry) {
    const StepWitness witness(state, entry.first);
    const std::vector<ImageSlot> witnesses = witness.Witnesses();
    const bool is_at_edge =
        std::ranges::any_of(witnesses, [&](ImageSlot other) { return !move.contains(other); });
    return is_at_edge && witness.Contradicts(entry.second);
  });
}

/// Makes the one move with which most rays agree, if more do than now. Poses alone are moved.
bool MakeBestMove(MappingState& state, const MappingOptions& options) {
  double most = CountAgreeingRays(state, options);
  std::optional<CandidateMove> best;
  for (const CandidateMove& move : ListCandidateMoves(state, options)) {
    const CandidateMove back = CentresNow(state, move);
    PutAt(state, move);
    const double agreeing = CountAgreeingRays(state, options);
    PutAt(state, back);
    if (agreeing <= most || IsAgainstGnss(state, move)) continue;
    most = agreeing;
    best = move;
  }
  if (best) PutAt(state, *best);
  return best.has_value();
}

/// How far each registered image was moved, by slot.
using Displacements = std::map<ImageSlot, Eigen::Vector3d>;

/// What all who see a point were moved by, if it was the same.
std::optional<Eigen::Vector3d> CommonDisplacement(const MappingState& state,
                                                  const MappedPoint& point,
                                                  const Displacements& moved) {
  const auto of = [&](Node node) -> const Eigen::Vector3d& {
    return moved.at(state.Graph().image_of_node[node]);
  };
  const Eigen::Vector3d first = of(point.nodes.front());
  const bool is_same = std::ranges::all_of(
      point.nodes, [&](Node node) { return (of(node) - first).norm() <= 1e-9 * first.norm(); });
  return is_same ? std::optional(first) : std::nullopt;
}

/// Points go along with the images that see them; those seen by images that were moved by different
/// amounts are made anew.
void RemakePoints(MappingState& state, const Displacements& moved, TrackLimits limits) {
  for (const PointIndex point : AllPoints(state)) {
    const MappedPoint& mapped = state.Point(point);
    if (const auto by = CommonDisplacement(state, mapped, moved)) {
      state.SetPosition(point, mapped.position + *by);
    } else {
      state.RemovePoint(point);
    }
  }
  limits.max_error_px *= kSlack;
  for (const auto& [image, by] : moved) TriangulateImage(state, image, limits);
}

}  // namespace

absl::StatusOr<bool> MendLengths(MappingState& state,
                                 const MappingOptions& options,
                                 const StageContext& context) {
  if (FindLengthFaults(state, options).empty()) return false;
  MappingState mended = state;
  int num_moves = 0;
  while (num_moves < kMaxMoves && MakeBestMove(mended, options)) {
    ++num_moves;
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  }
  if (num_moves == 0) return false;
  Displacements moved;
  for (const ImageSlot image : state.Registered())
    moved[image] = mended.Centre(image) - state.Centre(image);
  RemakePoints(mended, moved, LimitsOf(options));
  ORBWEAVE_RETURN_IF_ERROR(AdjustGrowingModel(mended, options, context));
  if (!SpeaksMoreFor(mended, state, options)) return false;
  state = std::move(mended);
  return true;
}

}  // namespace orbweave
