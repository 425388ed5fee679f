// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap_model.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "core/base/status.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

uint32_t ColmapId(ImageId id) { return id.value + 1; }

/// Adds one camera per image size in order of first use; returns the camera id of each image.
std::map<ImageId, uint32_t> AddCameras(const Reconstruction& reconstruction,
                                       const ImageManifest& manifest,
                                       ColmapModel& model) {
  std::map<ImageId, uint32_t> camera_ids;
  for (const auto& [id, image] : reconstruction.images) {
    const EquirectangularCamera& camera = manifest.At(id).camera;
    const auto known = std::find_if(model.cameras.begin(),
                                    model.cameras.end(),
                                    [&](const ColmapCamera& c) { return c.camera == camera; });
    if (known == model.cameras.end()) {
      model.cameras.push_back({static_cast<uint32_t>(model.cameras.size()) + 1, camera});
      camera_ids[id] = model.cameras.back().camera_id;
    } else {
      camera_ids[id] = known->camera_id;
    }
  }
  return camera_ids;
}

/// One observation on its way into an image's list.
struct Sighting {
  FeatureIndex feature = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  size_t track = 0;
};

std::map<ImageId, std::vector<Sighting>> SightingsByImage(const Reconstruction& reconstruction,
                                                          const ImageManifest& manifest) {
  std::map<ImageId, std::vector<Sighting>> sightings;
  for (size_t t = 0; t < reconstruction.tracks.size(); ++t) {
    for (const Observation& observation : reconstruction.tracks[t].observations) {
      const ImageId id = observation.ref.image;
      const Eigen::Vector2d pixel = manifest.At(id).camera.PixelFromBearing(observation.bearing);
      sightings[id].push_back({observation.ref.feature, pixel, t});
    }
  }
  for (auto& [id, list] : sightings) {
    std::sort(list.begin(), list.end(), [](const Sighting& a, const Sighting& b) {
      return std::pair(a.feature, a.track) < std::pair(b.feature, b.track);
    });
  }
  return sightings;
}

/// Lists the image's points2d and enters them into the tracks.
void AddPoints2d(const std::vector<Sighting>& sightings,
                 const std::vector<Keypoint>* keypoints,
                 ColmapImage& image,
                 ColmapModel& model) {
  if (keypoints != nullptr) {
    for (const Keypoint& keypoint : *keypoints)
      image.points2d.push_back({{keypoint.x_px, keypoint.y_px}, kNoColmapPoint});
  }
  for (const Sighting& sighting : sightings) {
    uint32_t index = sighting.feature;
    if (keypoints == nullptr) {
      index = static_cast<uint32_t>(image.points2d.size());
      image.points2d.push_back({sighting.pixel, kNoColmapPoint});
    }
    ORBWEAVE_CHECK(index < image.points2d.size());
    image.points2d[index].point3d_id = model.points[sighting.track].point3d_id;
    model.points[sighting.track].track.emplace_back(image.image_id, index);
  }
}

/// Mean angle between bearings and point, in pixels at the equator.
double MeanErrorPx(const Track& track,
                   const Reconstruction& reconstruction,
                   const ImageManifest& manifest) {
  double sum = 0.0;
  for (const Observation& observation : track.observations) {
    const RegisteredImage& image = reconstruction.images.at(observation.ref.image);
    const Eigen::Vector3d ray_in_cam = image.cam_from_world * track.point_in_world;
    sum += AngleBetween(observation.bearing, ray_in_cam) *
           manifest.At(observation.ref.image).camera.width_px / (2.0 * std::numbers::pi);
  }
  return track.observations.empty() ? 0.0 : sum / static_cast<double>(track.observations.size());
}

}  // namespace

ColmapModel ToColmapModel(const Reconstruction& reconstruction,
                          const ImageManifest& manifest,
                          const std::vector<std::vector<Keypoint>>& pixels_by_image) {
  ColmapModel model;
  const std::map<ImageId, uint32_t> camera_ids = AddCameras(reconstruction, manifest, model);
  for (size_t t = 0; t < reconstruction.tracks.size(); ++t) {
    const Track& track = reconstruction.tracks[t];
    model.points.push_back({t + 1,
                            track.point_in_world,
                            track.color,
                            MeanErrorPx(track, reconstruction, manifest),
                            {}});
  }
  const std::map<ImageId, std::vector<Sighting>> sightings =
      SightingsByImage(reconstruction, manifest);
  for (const auto& [id, registered] : reconstruction.images) {
    ColmapImage& image = model.images.emplace_back();
    image.image_id = ColmapId(id);
    image.camera_id = camera_ids.at(id);
    image.name = manifest.At(id).name;
    image.cam_from_world = registered.cam_from_world;
    const std::vector<Keypoint>* keypoints =
        pixels_by_image.empty() ? nullptr : &pixels_by_image[id.value];
    const auto list = sightings.find(id);
    AddPoints2d(
        list == sightings.end() ? std::vector<Sighting>() : list->second, keypoints, image, model);
  }
  return model;
}

}  // namespace orbweave
