// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/select_sources.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "core/geometry/cube_face.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr int kQuarters = 4;
constexpr int kSectors = kQuarters * kCubeFaces;
constexpr size_t kBestOfSector = 4;
constexpr double kMaxBaselines = 25.0;     // farther surfaces are known to a tenth at best
constexpr double kPixelSigmaRad = 1.5e-3;  // of a seed: half a pixel of 2048, matched twice
constexpr int kAssumedRanges = 6;
constexpr size_t kNearestAssumed = 24;  // panoramas that may see a point that is only assumed

using Scores = std::array<double, kSectors>;

int SectorOf(const Vector3d& bearing) {
  const int face = FaceOf(bearing);
  const Vector3d on_face = FaceFromCamera(face) * bearing;
  return kQuarters * face + (on_face.x() < 0.0 ? 0 : 1) + (on_face.y() < 0.0 ? 0 : 2);
}

Vector3d MiddleOf(int sector) {
  const int quarter = sector % kQuarters;
  const Vector3d on_face(quarter % 2 == 0 ? -0.5 : 0.5, quarter / 2 == 0 ? -0.5 : 0.5, 1.0);
  return (FaceFromCamera(sector / kQuarters).transpose() * on_face).normalized();
}

double AngleWeight(double angle_rad, const SourceOptions& options) {
  const double angle_deg = angle_rad * 180.0 / std::numbers::pi;
  if (angle_deg <= options.min_angle_deg || angle_deg >= options.max_angle_deg) return 0.0;
  const auto share = [angle_deg](double from_deg, double to_deg) {
    return std::log(angle_deg / from_deg) / std::log(to_deg / from_deg);
  };
  return std::clamp(angle_deg < options.best_angle_deg
                        ? share(options.min_angle_deg, options.best_angle_deg)
                        : share(options.max_angle_deg, options.best_angle_deg),
                    0.0,
                    1.0);
}

/// A panorama that sources are chosen for, and what speaks for which.
struct Viewer {
  ImageId id{};
  Rigid3 cam_from_world{};
  Vector3d centre = Vector3d::Zero();
  std::map<ImageId, Scores> votes{};
  std::vector<DepthSeed> seeds{};
};

/// Who sees a point, from where.
using Witnesses = std::vector<std::pair<ImageId, Vector3d>>;

/// Lets a common point vote. The widest angle at which it is seen, at most 90 degrees; radians.
double Vote(const Vector3d& point,
            const Witnesses& witnesses,
            const SourceOptions& options,
            Viewer& viewer) {
  const Vector3d ray = point - viewer.centre;
  const auto sector = static_cast<size_t>(SectorOf(viewer.cam_from_world.rotation * ray));
  double widest = 0.0;
  for (const auto& [id, centre] : witnesses) {
    const Vector3d other_ray = point - centre;
    const double nearer = std::min(ray.norm(), other_ray.norm());
    if (id == viewer.id || !(nearer > 0.0)) continue;
    const double angle = AngleBetween(ray, other_ray);
    widest = std::max(widest, std::min(angle, std::numbers::pi / 2.0));
    const double score =
        AngleWeight(angle, options) * nearer / std::max(ray.norm(), other_ray.norm());
    if (score > 0.0) viewer.votes[id][sector] += score;
  }
  return widest;
}

void AddSeed(const Vector3d& point, double widest_rad, Viewer& viewer) {
  if (!(std::sin(widest_rad) > 0.0)) return;
  const Vector3d in_cam = viewer.cam_from_world * point;
  const double range = in_cam.norm();
  viewer.seeds.push_back({.bearing = in_cam / range,
                          .range_m = range,
                          .sigma_m = range * kPixelSigmaRad / std::sin(widest_rad)});
}

Witnesses WitnessesOf(const Track& track, const std::map<ImageId, RegisteredImage>& images) {
  Witnesses witnesses;
  for (const Observation& seen : track.observations) {
    const auto image = images.find(seen.ref.image);
    if (image == images.end() || image->second.loose) continue;
    witnesses.emplace_back(image->first, image->second.cam_from_world.Centre());
  }
  return witnesses;
}

Witnesses NearestWitnesses(const Viewer& viewer, const std::map<ImageId, RegisteredImage>& images) {
  Witnesses witnesses;
  for (const auto& [id, image] : images) {
    if (!image.loose && id != viewer.id) witnesses.emplace_back(id, image.cam_from_world.Centre());
  }
  std::ranges::stable_sort(witnesses, {}, [&viewer](const auto& witness) {
    return (witness.second - viewer.centre).squaredNorm();
  });
  if (witnesses.size() > kNearestAssumed) witnesses.resize(kNearestAssumed);
  return witnesses;
}

/// Votes by points in the middle of every sector, at ranges in geometric progression.
void VoteByAssumedPoints(const std::map<ImageId, RegisteredImage>& images,
                         const SourceOptions& options,
                         Viewer& viewer) {
  const Witnesses witnesses = NearestWitnesses(viewer, images);
  const Rigid3 world_from_cam = viewer.cam_from_world.Inverse();
  const double step = std::pow(options.far_m / options.near_m, 1.0 / (kAssumedRanges - 1));
  for (int sector = 0; sector < kSectors; ++sector) {
    double range = options.near_m;
    for (int i = 0; i < kAssumedRanges; ++i, range *= step)
      Vote(world_from_cam * (range * MiddleOf(sector)), witnesses, options, viewer);
  }
}

/// The best scores of every sector, best first.
using BestOfSectors = std::array<std::vector<double>, kSectors>;

double GainOf(const Scores& scores, const BestOfSectors& best) {
  double gain = 0.0;
  for (size_t s = 0; s < scores.size(); ++s) {
    const double displaced = best[s].size() < kBestOfSector ? 0.0 : best[s].back();
    gain += std::max(0.0, scores[s] - displaced);
  }
  return gain;
}

void Take(const Scores& scores, BestOfSectors& best) {
  for (size_t s = 0; s < scores.size(); ++s) {
    best[s].push_back(scores[s]);
    std::ranges::sort(best[s], std::greater());
    best[s].resize(std::min(best[s].size(), kBestOfSector));
  }
}

std::vector<ImageId> ChooseGreedily(std::map<ImageId, Scores> candidates, int max_sources) {
  for (auto& [id, scores] : candidates) {
    for (double& score : scores) score = std::sqrt(score);
  }
  BestOfSectors best;
  std::vector<ImageId> chosen;
  while (chosen.size() < static_cast<size_t>(max_sources)) {
    double most = 0.0;
    auto next = candidates.end();
    for (auto it = candidates.begin(); it != candidates.end(); ++it) {
      const double gain = GainOf(it->second, best);
      if (gain <= most) continue;
      most = gain;
      next = it;
    }
    if (next == candidates.end()) break;
    Take(next->second, best);
    chosen.push_back(next->first);
    candidates.erase(next);
  }
  return chosen;
}

void SetRange(const Viewer& viewer,
              double longest_baseline,
              const SourceOptions& options,
              SourceChoice& choice) {
  choice.min_range_m = options.near_m;
  choice.max_range_m = options.far_m;
  if (viewer.seeds.empty()) return;
  std::vector<double> ranges;
  for (const DepthSeed& seed : viewer.seeds) ranges.push_back(seed.range_m);
  std::ranges::sort(ranges);
  const size_t few = ranges.size() / 100;
  choice.min_range_m = 0.5 * ranges[few];
  choice.max_range_m =
      std::min(2.0 * ranges[ranges.size() - 1 - few],
               std::max(kMaxBaselines * longest_baseline, 2.0 * choice.min_range_m));
}

SourceChoice ChoiceOf(Viewer viewer,
                      const std::map<ImageId, RegisteredImage>& images,
                      const SourceOptions& options) {
  SourceChoice choice{.image = viewer.id,
                      .sources = ChooseGreedily(std::move(viewer.votes), options.max_sources)};
  if (choice.sources.empty()) {
    choice.problem = "no other panorama sees the same surfaces from another place";
    return choice;
  }
  double longest = 0.0;
  for (const ImageId source : choice.sources)
    longest = std::max(longest, (images.at(source).cam_from_world.Centre() - viewer.centre).norm());
  SetRange(viewer, longest, options, choice);
  std::ranges::stable_sort(
      viewer.seeds, {}, [](const DepthSeed& seed) { return seed.sigma_m / seed.range_m; });
  viewer.seeds.resize(std::min(viewer.seeds.size(), static_cast<size_t>(options.max_seeds)));
  choice.seeds = std::move(viewer.seeds);
  return choice;
}

std::vector<Viewer> ViewersOf(const std::map<ImageId, RegisteredImage>& images,
                              std::span<const ImageId> wanted) {
  std::vector<Viewer> viewers;
  for (const ImageId id : wanted) {
    const Rigid3& pose = images.at(id).cam_from_world;
    viewers.push_back({.id = id, .cam_from_world = pose, .centre = pose.Centre()});
  }
  return viewers;
}

}  // namespace

std::vector<SourceChoice> SelectSources(const std::map<ImageId, RegisteredImage>& images,
                                        std::span<const ImageId> wanted,
                                        std::span<const Track> tracks,
                                        const SourceOptions& options) {
  std::vector<Viewer> viewers = ViewersOf(images, wanted);
  for (const Track& track : tracks) {
    const Witnesses witnesses = WitnessesOf(track, images);
    for (const auto& [id, centre] : witnesses) {
      const auto viewer = std::ranges::lower_bound(viewers, id, {}, &Viewer::id);
      if (viewer == viewers.end() || viewer->id != id || track.point_in_world == centre) continue;
      AddSeed(
          track.point_in_world, Vote(track.point_in_world, witnesses, options, *viewer), *viewer);
    }
  }
  std::vector<SourceChoice> choices;
  for (Viewer& viewer : viewers) {
    if (images.at(viewer.id).loose) {
      choices.push_back(
          {.image = viewer.id, .problem = "only a GNSS position places it, no observations"});
      continue;
    }
    if (viewer.votes.empty()) VoteByAssumedPoints(images, options, viewer);
    choices.push_back(ChoiceOf(std::move(viewer), images, options));
  }
  return choices;
}

}  // namespace orbweave
