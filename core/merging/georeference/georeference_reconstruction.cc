// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/georeference_reconstruction.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/status.h"
#include "core/merging/georeference/blame_gnss_or_model.h"
#include "core/merging/georeference/estimate_georeference.h"
#include "core/merging/georeference/estimate_gravity.h"
#include "core/merging/georeference/find_drive_errors.h"
#include "core/merging/georeference/gnss_agreement.h"
#include "core/merging/georeference/gnss_positions.h"
#include "core/merging/georeference/gnss_track.h"
#include "core/merging/georeference/refine_georeference.h"
#include "core/merging/georeference/tilt_inflation.h"

namespace orbweave {
namespace {

constexpr size_t kMinPositions = 4;
constexpr int kErrorRounds = 4;

// What drives have wrong in common, and how errors of neighbours hang together, are found beside a
// similarity, which is fitted again with them.
absl::Status FitWithErrors(const std::vector<GnssDrive>& drives,
                           const std::optional<Gravity>& gravity,
                           const StageContext& context,
                           GnssPositions& positions,
                           Georeference& result) {
  for (int round = 0; round < kErrorRounds; ++round) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    FoundDriveErrors found = FindDriveErrors(drives, *result.enu_from_world);
    result.drive_errors = std::move(found.drives);
    result.checks = std::move(found.checks);
    TakeOffErrors(result.drive_errors, drives, *result.enu_from_world, positions);
    result.gnss_inflation =
        TiltInflation(drives, positions.in_enu, gravity, *result.enu_from_world);
    // A fit that has leant over to follow two datums does not come back by itself.
    const bool has_datums = std::ranges::any_of(
        result.drive_errors, [](const DriveErrors& errors) { return !errors.offset_m.isZero(); });
    std::optional<Sim3> start = result.enu_from_world;
    if (has_datums && gravity) {
      ORBWEAVE_ASSIGN_OR_RETURN(start, EstimateLevel(positions, *gravity, context));
    }
    if (!start) continue;
    result.enu_from_world =
        RefineGeoreference(positions.Pairs(), gravity, result.gnss_inflation, *start);
    if (!gravity || !LeansTooFar(*gravity, *result.enu_from_world)) continue;
    ORBWEAVE_ASSIGN_OR_RETURN(start, EstimateLevel(positions, *gravity, context));
    if (start) result.enu_from_world = start;
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<Georeference> GeoreferenceReconstruction(const Reconstruction& reconstruction,
                                                        const ImageManifest& manifest,
                                                        GnssUse use,
                                                        const StageContext& context) {
  Georeference result;
  if (use == GnssUse::kOff) {
    result.reason = "switched off";
    return result;
  }
  const std::vector<GnssDrive> drives = GnssDrivesOf(reconstruction, manifest);
  GnssPositions positions = PositionsOf(drives);
  if (positions.size() < kMinPositions) {
    result.reason = positions.size() == 0 ? "no image has a GNSS position"
                                          : std::to_string(positions.size()) +
                                                " images with a GNSS position are too few";
    return result;
  }
  const std::optional<Gravity> gravity = EstimateGravity(reconstruction, manifest);
  ORBWEAVE_ASSIGN_OR_RETURN(result.enu_from_world,
                            EstimateGeoreference(positions, gravity, context));
  if (!result.enu_from_world) {
    result.reason = "no similarity fits the GNSS positions to the model";
    return result;
  }
  ORBWEAVE_RETURN_IF_ERROR(FitWithErrors(drives, gravity, context, positions, result));
  const GnssAgreement agreement = MeasureAgreement(positions, result);
  if (!result.enu_from_world || !agreement.IsUsual())
    ORBWEAVE_RETURN_IF_ERROR(BlameGnssOrModel(drives, gravity, agreement, context, result));
  return result;
}

}  // namespace orbweave
