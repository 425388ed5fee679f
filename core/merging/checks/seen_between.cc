// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/seen_between.h"

#include <algorithm>
#include <span>

#include "core/geometry/rotation.h"
#include "core/geometry/stands_between.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kMaxTracks = 100000;

struct Panorama {
  ImageId id{};
  Vector3d centre = Vector3d::Zero();
};

std::vector<Panorama> PanoramasOf(const Subproblem& subproblem) {
  std::vector<Panorama> panoramas;
  for (const auto& [id, image] : subproblem.scene.images) {
    if (!image.loose) panoramas.push_back({id, image.cam_from_world.Centre()});
  }
  return panoramas;
}

/// Those who see a point: where they are from it, and under which angles it sees any two of them.
class Sights {
 public:
  Sights(const Track& track, const Reconstruction& scene) {
    for (const Observation& seen : track.observations) {
      const RegisteredImage& image = scene.images.at(seen.ref.image);
      if (image.loose) continue;
      images_.push_back(seen.ref.image);
      from_point_.emplace_back(image.cam_from_world.Centre() - track.point_in_world);
      reach_ = std::max(reach_, kMaxFartherBetween * from_point_.back().norm());
    }
    for (const Vector3d& one : from_point_) {
      for (const Vector3d& other : from_point_) apart_rad_.push_back(AngleBetween(one, other));
    }
  }

  /// As far as anybody is asked.
  [[nodiscard]] double Reach() const { return reach_; }
  [[nodiscard]] bool Has(ImageId image) const {
    return std::ranges::find(images_, image) != images_.end();
  }
  /// Whether any two others see the point from either side of one who stands there.
  [[nodiscard]] bool AreOnEitherSideOf(ImageId image, const Vector3d& from_point) const {
    const double distance = from_point.norm();
    std::vector<double> to_rad;
    for (const Vector3d& each : from_point_) to_rad.push_back(AngleBetween(each, from_point));
    for (size_t i = 0; i < images_.size(); ++i) {
      for (size_t k = i + 1; k < images_.size(); ++k) {
        if (images_[i] == image || images_[k] == image) continue;
        const double apart_rad = apart_rad_[i * images_.size() + k];
        const double farther = std::max(from_point_[i].norm(), from_point_[k].norm());
        if (StandsBetween({apart_rad, farther}, to_rad[i], to_rad[k], distance)) return true;
      }
    }
    return false;
  }

 private:
  std::vector<ImageId> images_{};
  std::vector<Vector3d> from_point_{};
  std::vector<double> apart_rad_{};  ///< images_.size() rows and columns
  double reach_ = 0.0;
};

void Ask(const Track& track,
         const Reconstruction& scene,
         std::span<const Panorama> panoramas,
         std::span<SeenBetween> counts) {
  const Sights sights(track, scene);
  for (size_t i = 0; i < panoramas.size(); ++i) {
    const Vector3d from_point = panoramas[i].centre - track.point_in_world;
    if (from_point.squaredNorm() > sights.Reach() * sights.Reach()) continue;
    if (!sights.AreOnEitherSideOf(panoramas[i].id, from_point)) continue;
    ++counts[i].asked;
    counts[i].seen += sights.Has(panoramas[i].id) ? 1 : 0;
  }
}

}  // namespace

std::vector<SeenBetween> CountSeenBetween(const Subproblem& subproblem) {
  const std::vector<Panorama> panoramas = PanoramasOf(subproblem);
  std::vector<SeenBetween> counts;
  for (const Panorama& panorama : panoramas) counts.push_back({.image = panorama.id});
  const std::vector<Track>& tracks = subproblem.scene.tracks;
  const size_t step = tracks.size() / kMaxTracks + 1;
  for (size_t i = 0; i < tracks.size(); i += step)
    Ask(tracks[i], subproblem.scene, panoramas, counts);
  std::erase_if(counts, [](const SeenBetween& count) { return count.asked == 0; });
  return counts;
}

}  // namespace orbweave
