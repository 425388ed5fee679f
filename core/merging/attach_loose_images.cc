// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/attach_loose_images.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <set>

#include "core/merging/georeference/gnss_track.h"

namespace orbweave {
namespace {

/// What is known of the observed images of each drive.
template <typename T>
using OfDrives = std::map<uint32_t, std::map<ImageId, T>>;

OfDrives<Eigen::Quaterniond> TurnsOf(const FinalisedWorld& world, const ImageManifest& manifest) {
  OfDrives<Eigen::Quaterniond> turns;
  for (const auto& [id, image] : world.images) {
    if (!image.loose) turns[manifest.At(id).drive][id] = image.cam_from_world.rotation;
  }
  return turns;
}

/// By how much the positions of observed images are wrong, as far as is known.
OfDrives<Eigen::Vector3d> PositionErrorsOf(const FinalisedWorld& world,
                                           const ImageManifest& manifest,
                                           std::span<const DriveErrors> drive_errors) {
  OfDrives<Eigen::Vector3d> errors_m;
  if (drive_errors.empty()) return errors_m;
  for (const GnssDrive& drive : GnssDrivesOf({.images = world.images}, manifest)) {
    const auto found = std::ranges::find(drive_errors, drive.drive, &DriveErrors::drive);
    if (found == drive_errors.end()) continue;
    for (const DrivenFix& fix : drive.fixes)
      errors_m[drive.drive][fix.image] = ErrorAt(*found, fix, Sim3{});
  }
  return errors_m;
}

/// That of the image of the same drive that is next to this one in id order, of two the earlier;
/// null where the drive has none.
template <typename T>
const T* Nearest(const OfDrives<T>& of_drives, const ImageRecord& image) {
  const auto drive = of_drives.find(image.drive);
  if (drive == of_drives.end()) return nullptr;
  const auto after = drive->second.upper_bound(image.id);
  if (after == drive->second.begin()) return &after->second;
  const auto before = std::prev(after);
  if (after == drive->second.end()) return &before->second;
  const bool is_nearer_to_next =
      after->first.value - image.id.value < image.id.value - before->first.value;
  return is_nearer_to_next ? &after->second : &before->second;
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

}  // namespace

void AttachLooseImages(const ImageManifest& manifest,
                       std::span<const DriveErrors> drive_errors,
                       std::vector<FinalisedWorld>& worlds) {
  const auto is_georeferenced = [](const FinalisedWorld& world) { return world.report.gnss.used; };
  const auto main = std::ranges::find_if(worlds, is_georeferenced);
  if (main == worlds.end()) return;
  std::set<ImageId> placed;
  for (const FinalisedWorld& world : worlds) {
    if (!is_georeferenced(world)) continue;
    for (const auto& [id, image] : world.images) placed.insert(id);
  }
  const OfDrives<Eigen::Quaterniond> turns = TurnsOf(*main, manifest);
  const OfDrives<Eigen::Vector3d> errors_m = PositionErrorsOf(*main, manifest, drive_errors);
  for (const ImageRecord& image : manifest.images) {
    if (!image.prior.position_in_enu || placed.contains(image.id)) continue;
    const Eigen::Quaterniond* like = Nearest(turns, image);
    const Eigen::Vector3d* error_m = Nearest(errors_m, image);
    const Eigen::Quaterniond turn =
        like != nullptr ? *like : LevelCamera(image.prior.heading_deg.value_or(0.0));
    Eigen::Vector3d centre_m = *image.prior.position_in_enu;
    if (error_m != nullptr) centre_m -= *error_m;
    main->images[image.id] = {.cam_from_world = Rigid3{turn, -(turn * centre_m)}, .loose = true};
  }
}

}  // namespace orbweave
