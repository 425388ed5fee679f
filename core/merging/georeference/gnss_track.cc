// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/gnss_track.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/merging/georeference/drive_sequences.h"
#include "core/merging/georeference/moves_along.h"

namespace orbweave {
namespace {

bool HasTimes(const GnssDrive& drive, const ImageManifest& manifest) {
  const auto time = [&](const DrivenFix& fix) {
    return manifest.At(fix.image).capture_time_s.value_or(NAN);
  };
  const bool all = std::ranges::all_of(
      drive.fixes, [&](const DrivenFix& fix) { return std::isfinite(time(fix)); });
  return all && time(drive.fixes.front()) < time(drive.fixes.back());
}

void MeasureWays(GnssDrive& drive) {
  for (size_t i = 1; i < drive.fixes.size(); ++i) {
    const DrivenFix& before = drive.fixes[i - 1];
    drive.fixes[i].way =
        before.way + (drive.fixes[i].centre_in_world - before.centre_in_world).norm();
  }
}

void MeasureTravel(const ImageManifest& manifest, GnssDrive& drive) {
  std::vector<Eigen::Vector3d> centres;
  for (const DrivenFix& fix : drive.fixes) centres.push_back(fix.centre_in_world);
  const std::vector<MoveAlong> moves = MovesAlong(centres);
  for (size_t i = 0; i < moves.size(); ++i) {
    const MoveAlong& move = moves[i];
    if (move.moved.isZero(0.0)) continue;
    if (!drive.has_times) {
      drive.fixes[i].travel = move.moved.normalized();
      continue;
    }
    const double seconds = *manifest.At(drive.fixes[move.last].image).capture_time_s -
                           *manifest.At(drive.fixes[move.first].image).capture_time_s;
    if (seconds > 0.0) drive.fixes[i].travel = move.moved / seconds;
  }
}

}  // namespace

std::vector<GnssDrive> GnssDrivesOf(const Reconstruction& reconstruction,
                                    const ImageManifest& manifest) {
  std::map<ImageId, Eigen::Vector3d> centres;
  for (const auto& [id, image] : reconstruction.images) {
    if (!image.loose && manifest.At(id).prior.position_in_enu)
      centres[id] = image.cam_from_world.Centre();
  }
  std::vector<GnssDrive> drives;
  for (const DriveSequence& sequence : DriveSequences(centres, manifest)) {
    GnssDrive& drive = drives.emplace_back(GnssDrive{.drive = sequence.drive});
    for (const ImageId id : sequence.images) {
      const PosePrior& prior = manifest.At(id).prior;
      drive.fixes.push_back({.image = id,
                             .centre_in_world = centres.at(id),
                             .position_in_enu = *prior.position_in_enu,
                             .horizontal_sigma_m = prior.horizontal_sigma_m,
                             .vertical_sigma_m = prior.vertical_sigma_m});
    }
    drive.has_times = HasTimes(drive, manifest);
    MeasureWays(drive);
    if (!sequence.is_by_place) MeasureTravel(manifest, drive);
  }
  return drives;
}

}  // namespace orbweave
