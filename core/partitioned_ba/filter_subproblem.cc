// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/filter_subproblem.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/bundle/bearing_error.h"
#include "core/estimators/triangulate_rays.h"

namespace orbweave {
namespace {

/// What observations of an image are judged by.
struct Judge {
  ImageId id{};
  Rigid3 cam_from_world{};
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double max_error_rad = 0.0;
};

class Judges {
 public:
  Judges(const Subproblem& subproblem, double max_error_px) {
    for (const SubproblemImage& image : subproblem.images) {
      const Rigid3& pose = subproblem.scene.images.at(image.id).cam_from_world;
      judges_.push_back(
          {image.id, pose, pose.Centre(), image.camera.AngleFromPixels(max_error_px)});
    }
  }

  [[nodiscard]] const Judge& Of(ImageId id) const {
    return *std::ranges::lower_bound(judges_, id, {}, &Judge::id);
  }

 private:
  std::vector<Judge> judges_;
};

/// Returns how many observations were removed.
uint32_t RemoveBadObservations(const Judges& judges, Track& track) {
  return static_cast<uint32_t>(std::erase_if(track.observations, [&](const Observation& seen) {
    const Judge& judge = judges.Of(seen.ref.image);
    return BearingError(judge.cam_from_world, track.point_in_world, seen.bearing) >
           judge.max_error_rad;
  }));
}

bool IsGood(const Judges& judges, const Track& track, double min_angle_rad) {
  if (track.observations.size() < 2) return false;
  std::vector<Eigen::Vector3d> centres;
  for (const Observation& seen : track.observations) {
    centres.push_back(judges.Of(seen.ref.image).centre);
  }
  return MaxTriangulationAngle(track.point_in_world, centres) >= min_angle_rad &&
         RangeGap(track.point_in_world, centres) <= kMaxRangeGap;
}

}  // namespace

FilteredSubproblem FilterSubproblem(Subproblem subproblem,
                                    double max_error_px,
                                    double min_angle_rad) {
  const Judges judges(subproblem, max_error_px);
  FilteredSubproblem filtered;
  for (Track& track : subproblem.scene.tracks)
    filtered.removed_observations += RemoveBadObservations(judges, track);
  filtered.removed_tracks =
      static_cast<uint32_t>(std::erase_if(subproblem.scene.tracks, [&](const Track& track) {
        if (IsGood(judges, track, min_angle_rad)) return false;
        filtered.removed_observations += static_cast<uint32_t>(track.observations.size());
        return true;
      }));
  subproblem.scene.SortTracks();  // a track is named by its first observation
  for (SplitTrack& track : subproblem.split)
    filtered.removed_observations += RemoveBadObservations(judges, track.part);
  std::erase_if(subproblem.split,
                [](const SplitTrack& track) { return track.part.observations.empty(); });
  filtered.subproblem = std::move(subproblem);
  return filtered;
}

}  // namespace orbweave
