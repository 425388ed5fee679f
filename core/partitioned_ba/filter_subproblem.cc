// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/filter_subproblem.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/bundle/bearing_error.h"
#include "core/estimators/triangulate_rays.h"

namespace orbweave {
namespace {

/// Of a slow camera, which sees all points under small angles, a share of those is enough.
constexpr double kOfMedian = 0.25;

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

/// The largest angle under which two observations see each track, radians; 0 where fewer are left,
/// and where one image alone would see it from close up.
std::vector<double> AnglesOf(const Judges& judges, const std::vector<Track>& tracks) {
  std::vector<double> angles_rad;
  angles_rad.reserve(tracks.size());
  for (const Track& track : tracks) {
    std::vector<Eigen::Vector3d> centres;
    for (const Observation& seen : track.observations)
      centres.push_back(judges.Of(seen.ref.image).centre);
    const bool is_seen =
        centres.size() > 1 && RangeGap(track.point_in_world, centres) <= kMaxRangeGap;
    angles_rad.push_back(is_seen ? MaxTriangulationAngle(track.point_in_world, centres) : 0.0);
  }
  return angles_rad;
}

/// Returns how many observations went with the tracks.
uint32_t RemoveBadTracks(const Judges& judges, double min_angle_rad, std::vector<Track>& tracks) {
  if (tracks.empty()) return 0;
  const std::vector<double> angles_rad = AnglesOf(judges, tracks);
  const double limit_rad = std::min(min_angle_rad, kOfMedian * UpperMedian(angles_rad));
  uint32_t removed = 0;
  size_t kept = 0;
  for (size_t i = 0; i < tracks.size(); ++i) {
    if (tracks[i].observations.size() < 2 || angles_rad[i] < limit_rad) {
      removed += static_cast<uint32_t>(tracks[i].observations.size());
    } else {
      std::swap(tracks[kept++], tracks[i]);
    }
  }
  tracks.resize(kept);
  return removed;
}

}  // namespace

FilteredSubproblem FilterSubproblem(Subproblem subproblem,
                                    double max_error_px,
                                    double min_angle_rad) {
  const Judges judges(subproblem, max_error_px);
  FilteredSubproblem filtered;
  for (Track& track : subproblem.scene.tracks)
    filtered.removed_observations += RemoveBadObservations(judges, track);
  const size_t num_tracks = subproblem.scene.tracks.size();
  filtered.removed_observations += RemoveBadTracks(judges, min_angle_rad, subproblem.scene.tracks);
  filtered.removed_tracks = static_cast<uint32_t>(num_tracks - subproblem.scene.tracks.size());
  subproblem.scene.SortTracks();  // a track is named by its first observation
  for (SplitTrack& track : subproblem.split)
    filtered.removed_observations += RemoveBadObservations(judges, track.part);
  std::erase_if(subproblem.split,
                [](const SplitTrack& track) { return track.part.observations.empty(); });
  filtered.subproblem = std::move(subproblem);
  return filtered;
}

}  // namespace orbweave
