// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/attach_loose_images.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <set>

namespace orbweave {
namespace {

/// Rotations of observed images by drive.
using Turns = std::map<uint32_t, std::map<ImageId, Eigen::Quaterniond>>;

Turns TurnsOf(const FinalisedWorld& world, const ImageManifest& manifest) {
  Turns turns;
  for (const auto& [id, image] : world.images) {
    if (!image.loose) turns[manifest.At(id).drive][id] = image.cam_from_world.rotation;
  }
  return turns;
}

/// A camera with x to the right, y down and z horizontal, `heading_deg` clockwise from north, in an
/// east-north-up world.
Eigen::Quaterniond LevelCamera(double heading_deg) {
  const double heading = heading_deg * std::numbers::pi / 180.0;
  Eigen::Matrix3d cam_from_world;
  cam_from_world << std::cos(heading), -std::sin(heading), 0.0,  //
      0.0, 0.0, -1.0,                                            //
      std::sin(heading), std::cos(heading), 0.0;
  return Eigen::Quaterniond(cam_from_world);
}

Eigen::Quaterniond TurnOf(const ImageRecord& image, const Turns& turns) {
  const auto drive = turns.find(image.drive);
  if (drive == turns.end()) return LevelCamera(image.prior.heading_deg.value_or(0.0));
  const auto after = drive->second.upper_bound(image.id);
  if (after == drive->second.begin()) return after->second;
  const auto before = std::prev(after);
  if (after == drive->second.end()) return before->second;
  const bool is_nearer_to_next =
      after->first.value - image.id.value < image.id.value - before->first.value;
  return is_nearer_to_next ? after->second : before->second;
}

}  // namespace

void AttachLooseImages(const ImageManifest& manifest, std::vector<FinalisedWorld>& worlds) {
  const auto is_georeferenced = [](const FinalisedWorld& world) { return world.report.gnss.used; };
  const auto main = std::ranges::find_if(worlds, is_georeferenced);
  if (main == worlds.end()) return;
  std::set<ImageId> placed;
  for (const FinalisedWorld& world : worlds) {
    if (!is_georeferenced(world)) continue;
    for (const auto& [id, image] : world.images) placed.insert(id);
  }
  const Turns turns = TurnsOf(*main, manifest);
  for (const ImageRecord& image : manifest.images) {
    if (!image.prior.position_in_enu || placed.contains(image.id)) continue;
    const Eigen::Quaterniond turn = TurnOf(image, turns);
    main->images[image.id] = {
        .cam_from_world = Rigid3{turn, -(turn * *image.prior.position_in_enu)}, .loose = true};
  }
}

}  // namespace orbweave
