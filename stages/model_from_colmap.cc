// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/model_from_colmap.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/images/match_names.h"

namespace orbweave {
namespace {

constexpr size_t kImagesPerSubproblem = 100;

bool IsFinite(const Rigid3& pose) {
  return pose.rotation.coeffs().allFinite() && pose.translation.allFinite();
}

std::vector<std::string> NamesOf(const ImageManifest& manifest) {
  std::vector<std::string> names;
  for (const ImageRecord& image : manifest.images) names.push_back(image.name);
  return names;
}

std::vector<std::string> NamesOf(const ColmapModel& model) {
  std::vector<std::string> names;
  for (const ColmapImage& image : model.images) names.push_back(image.name);
  return names;
}

/// Images of the manifest by their id in the model.
using ImageOfColmap = std::map<uint32_t, ImageId>;

ImageOfColmap MatchImages(const ColmapModel& model,
                          const ImageManifest& manifest,
                          ImportedModel& imported) {
  const auto rows = MatchNames(NamesOf(manifest), NamesOf(model));
  ImageOfColmap ids;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i]) continue;
    const ColmapImage& image = model.images[*rows[i]];
    ids[image.image_id] = manifest.images[i].id;
    if (IsFinite(image.cam_from_world))
      imported.world.images[manifest.images[i].id].cam_from_world = image.cam_from_world;
  }
  for (const ColmapImage& image : model.images) {
    if (!ids.contains(image.image_id))
      imported.without_image.push_back({image.name, "the folder has no such image"});
  }
  return ids;
}

std::optional<Track> TrackOf(const ColmapPoint3d& point,
                             const ImageOfColmap& ids,
                             const std::map<ImageId, RegisteredImage>& images) {
  Track track{.point_in_world = point.point_in_world, .color = point.color};
  std::set<ImageId> seen;
  for (const auto& [image_id, feature] : point.track) {
    const auto id = ids.find(image_id);
    const auto image = id == ids.end() ? images.end() : images.find(id->second);
    if (image == images.end() || !seen.insert(id->second).second) continue;
    const Eigen::Vector3d in_cam = image->second.cam_from_world * point.point_in_world;
    if (!(in_cam.norm() > 0.0) || !in_cam.allFinite()) continue;
    track.observations.push_back({.ref = {id->second, feature}, .bearing = in_cam.normalized()});
  }
  if (track.observations.size() < 2) return std::nullopt;
  std::ranges::sort(track.observations, {}, &Observation::ref);
  return track;
}

/// Adds to the scene what its tracks see and it does not own.
void CompleteScene(const ImageManifest& manifest,
                   const std::map<ImageId, RegisteredImage>& images,
                   const std::map<ImageId, uint32_t>& owners,
                   Subproblem& subproblem) {
  for (const Track& track : subproblem.scene.tracks) {
    for (const Observation& seen : track.observations)
      subproblem.scene.images[seen.ref.image] = images.at(seen.ref.image);
  }
  for (const auto& [id, image] : subproblem.scene.images) {
    subproblem.images.push_back(
        {.id = id, .camera = manifest.At(id).camera, .owner = owners.at(id)});
  }
  subproblem.scene.SortTracks();
}

std::vector<Subproblem> Divide(const ImageManifest& manifest,
                               const std::map<ImageId, RegisteredImage>& images,
                               const std::vector<Track>& tracks) {
  std::vector<Subproblem> subproblems;
  std::map<ImageId, uint32_t> owners;
  for (const auto& [id, image] : images) {
    const size_t owner = owners.size() / kImagesPerSubproblem;
    if (owner == subproblems.size())
      subproblems.push_back({.cluster = static_cast<uint32_t>(owner)});
    subproblems[owner].scene.images[id] = image;
    owners[id] = static_cast<uint32_t>(owner);
  }
  for (const Track& track : tracks) {
    std::set<uint32_t> seen_by;  // every owner of an image that sees it chooses by it
    for (const Observation& seen : track.observations) seen_by.insert(owners.at(seen.ref.image));
    for (const uint32_t owner : seen_by) subproblems[owner].scene.tracks.push_back(track);
  }
  for (Subproblem& subproblem : subproblems) CompleteScene(manifest, images, owners, subproblem);
  return subproblems;
}

std::string FirstOf(const std::vector<std::string>& names) {
  return names.empty() ? "none" : absl::StrCat("'", names.front(), "', ...");
}

}  // namespace

absl::StatusOr<ImportedModel> ModelFromColmap(const ColmapModel& model,
                                              const ImageManifest& manifest) {
  ImportedModel imported;
  const ImageOfColmap ids = MatchImages(model, manifest, imported);
  const std::map<ImageId, RegisteredImage>& images = imported.world.images;
  if (images.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat("no image of the model is in the folder: the "
                     "model has ",
                     FirstOf(NamesOf(model)),
                     " the folder ",
                     FirstOf(NamesOf(manifest))));
  }
  std::vector<Track> tracks;
  for (const ColmapPoint3d& point : model.points) {
    if (auto track = TrackOf(point, ids, images)) tracks.push_back(*std::move(track));
  }
  imported.subproblems = Divide(manifest, images, tracks);
  return imported;
}

}  // namespace orbweave
