// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/filter_observations.h"

#include <vector>

#include "core/bundle/adjust_bundle.h"
#include "core/estimators/triangulate_rays.h"

namespace orbweave {
namespace {

// What an observation is judged by; absent for images without a pose of their own.
struct Judge {
  bool has_pose = false;
  Rigid3 cam_from_world{};
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double max_error_rad = 0.0;
};

std::vector<Judge> MakeJudges(const Reconstruction& reconstruction,
                              const ImageManifest& manifest,
                              double max_error_px) {
  std::vector<Judge> judges(manifest.images.size());
  for (const auto& [id, image] : reconstruction.images) {
    judges[id.value] = {.has_pose = !image.loose,
                        .cam_from_world = image.cam_from_world,
                        .centre = image.cam_from_world.Centre(),
                        .max_error_rad = manifest.At(id).camera.AngleFromPixels(max_error_px)};
  }
  return judges;
}

bool IsGood(const Judge& judge,
            const Eigen::Vector3d& point_in_world,
            const Eigen::Vector3d& bearing) {
  return judge.has_pose &&
         BearingError(judge.cam_from_world, point_in_world, bearing) <= judge.max_error_rad;
}

bool IsGood(const Track& track, const std::vector<Judge>& judges, double min_angle_rad) {
  if (track.observations.size() < 2) return false;
  std::vector<Eigen::Vector3d> centres;
  for (const Observation& seen : track.observations) {
    centres.push_back(judges[seen.ref.image.value].centre);
  }
  return MaxTriangulationAngle(track.point_in_world, centres) >= min_angle_rad;
}

}  // namespace

FilteredReconstruction FilterObservations(Reconstruction reconstruction,
                                          const ImageManifest& manifest,
                                          double max_error_px,
                                          double min_angle_rad) {
  const std::vector<Judge> judges = MakeJudges(reconstruction, manifest, max_error_px);
  const size_t num_observations = reconstruction.NumObservations();
  const size_t num_tracks = reconstruction.tracks.size();
  for (Track& track : reconstruction.tracks) {
    std::erase_if(track.observations, [&](const Observation& seen) {
      return !IsGood(judges[seen.ref.image.value], track.point_in_world, seen.bearing);
    });
  }
  std::erase_if(reconstruction.tracks,
                [&](const Track& track) { return !IsGood(track, judges, min_angle_rad); });
  reconstruction.SortTracks();  // a track is named by its first observation
  FilteredReconstruction result{.reconstruction = std::move(reconstruction)};
  result.removed_observations =
      static_cast<uint32_t>(num_observations - result.reconstruction.NumObservations());
  result.removed_tracks = static_cast<uint32_t>(num_tracks - result.reconstruction.tracks.size());
  return result;
}

}  // namespace orbweave
