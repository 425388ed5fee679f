// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mend_lengths.h"

#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/mapping/adjust_local.h"
#include "core/mapping/centre_by_lengths.h"
#include "core/mapping/compare_models.h"
#include "core/mapping/mapping_schedule.h"
#include "core/mapping/measure_pair_lengths.h"
#include "core/mapping/step_witness.h"
#include "core/mapping/triangulate_tracks.h"

namespace orbweave {
namespace {

constexpr int kMaxRounds = 6;
/// Images that go to and fro have no place.
constexpr int kMaxMoves = 2;

/// Those at a fault.
std::set<ImageSlot> ImagesAtFaults(const MappingState& state, const MappingOptions& options) {
  std::set<ImageSlot> images;
  for (const LengthFault& fault : FindLengthFaults(state, options)) {
    for (const std::optional<ImageId> id : {std::optional(fault.image), fault.next}) {
      if (!id) continue;
      const ImageSlot image = SlotOf(state.Problem(), *id).value();
      if (state.IsRegistered(image)) images.insert(image);
    }
  }
  return images;
}

/// As it becomes with the image there.
absl::StatusOr<MappingState> Moved(MappingState state,
                                   ImageSlot image,
                                   const Eigen::Vector3d& centre,
                                   const MappingOptions& options,
                                   const StageContext& context) {
  const Eigen::Quaterniond rotation = state.CamFromWorld(image).rotation;
  state.Deregister(image);
  state.Register(image, Rigid3::FromCentre(rotation, centre));
  TriangulateImage(state, image, LimitsOf(options));
  ORBWEAVE_RETURN_IF_ERROR(AdjustLocally(state, image, options, context));
  return state;
}

/// Moves what is at faults, while more rays agree with each move; how many were made.
absl::StatusOr<int> MoveImages(const MappingOptions& options,
                               const StageContext& context,
                               MappingState& state) {
  std::map<ImageSlot, int> moves;
  int num_moved = 0;
  double agreeing = CountAgreeingRays(state, options);
  for (int round = 0; round < kMaxRounds; ++round) {
    const int before = num_moved;
    for (const ImageSlot image : ImagesAtFaults(state, options)) {
      ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
      if (moves[image] == kMaxMoves) continue;
      const std::optional<Eigen::Vector3d> centre = CentreByLengths(state, image, options);
      if (!centre || StepWitness(state, image).Contradicts(*centre)) continue;
      ++moves[image];
      ORBWEAVE_ASSIGN_OR_RETURN(MappingState moved, Moved(state, image, *centre, options, context));
      const double moved_agreeing = CountAgreeingRays(moved, options);
      if (moved_agreeing <= agreeing) continue;
      agreeing = moved_agreeing;
      state = std::move(moved);
      ++num_moved;
    }
    if (num_moved == before) break;
  }
  return num_moved;
}

}  // namespace

absl::StatusOr<int> MendLengths(MappingState& state,
                                const MappingOptions& options,
                                const StageContext& context) {
  if (FindLengthFaults(state, options).empty()) return 0;
  MappingState mended = state;
  ORBWEAVE_ASSIGN_OR_RETURN(const int num_moved, MoveImages(options, context, mended));
  if (num_moved == 0 || !SpeaksMoreFor(mended, state, options)) return 0;
  state = std::move(mended);
  return num_moved;
}

}  // namespace orbweave
