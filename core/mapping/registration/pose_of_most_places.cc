// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/pose_of_most_places.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/estimators/estimate_absolute_pose.h"
#include "core/geometry/sphere_cells.h"
#include "core/mapping/registration/baseline_length.h"
#include "core/mapping/registration/pair_witness.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kMaxViews = 5;
constexpr size_t kMaxLengths = 100;  ///< per view that are tried
constexpr int kMaxRounds = 3;        ///< of refinement

constexpr uint32_t kCells = kSpreadCells * kSpreadCells;

using Places = std::bitset<kCells>;

/// The places of correspondences that agree with cameras of one rotation.
class PlaceCounter {
 public:
  PlaceCounter(const Eigen::Quaterniond& cam_from_world,
               const SceneCorrespondences& correspondences,
               double max_error_rad)
      : positions_(correspondences.positions), min_cos_(std::cos(max_error_rad)) {
    std::vector<uint32_t> cells;
    for (const Vector3d& bearing : correspondences.bearings) {
      rays_.push_back(cam_from_world.conjugate() * bearing);
      cells.push_back(SphereCell(bearing, kSpreadCells));
    }
    std::array<uint32_t, kCells + 1> next{};  // of each cell in by_place_
    for (const uint32_t cell : cells) ++next[cell + 1];
    for (uint32_t cell = 0; cell < kCells; ++cell) {
      const uint32_t first = next[cell];
      next[cell + 1] += first;
      if (next[cell + 1] > first) places_.push_back({cell, first, next[cell + 1]});
    }
    by_place_.resize(rays_.size());
    for (uint32_t i = 0; i < cells.size(); ++i) by_place_[next[cells[i]]++] = i;
  }

  [[nodiscard]] Places At(const Vector3d& centre) const {
    Places places;
    for (const Place& place : places_) {
      if (Agrees(place, centre)) places.set(place.cell);
    }
    return places;
  }
  /// How many agree, where these are more than `fewer`; else some number that is not.
  [[nodiscard]] size_t CountAt(const Vector3d& centre, size_t fewer = 0) const {
    size_t count = 0;
    for (size_t k = 0; k < places_.size(); ++k) {
      if (count + (places_.size() - k) <= fewer) break;
      count += Agrees(places_[k], centre) ? 1 : 0;
    }
    return count;
  }
  /// Of those steps from `start` in `direction` whose lengths points tell, that of most places;
  /// `best` and `most` where none has more.
  void FindBest(const Vector3d& start,
                const Vector3d& direction,
                Vector3d& best,
                size_t& most) const {
    if (most == places_.size()) return;
    const size_t stride = std::max<size_t>(1, (rays_.size() + kMaxLengths - 1) / kMaxLengths);
    for (size_t i = 0; i < rays_.size(); i += stride) {
      const double s = BaselineLength(positions_[i] - start, direction, rays_[i]);
      if (s == 0.0) continue;
      const Vector3d centre = start + s * direction;
      const size_t places = CountAt(centre, most);
      if (places <= most) continue;
      most = places;
      best = centre;
    }
  }

 private:
  /// A cell that holds correspondences: by_place_[first, end).
  struct Place {
    uint32_t cell = 0;
    uint32_t first = 0;
    uint32_t end = 0;
  };

  [[nodiscard]] bool Agrees(const Place& place, const Vector3d& centre) const {
    return std::any_of(
        by_place_.begin() + place.first, by_place_.begin() + place.end, [&](uint32_t i) {
          const Vector3d seen = positions_[i] - centre;
          return seen.dot(rays_[i]) >= min_cos_ * seen.norm();
        });
  }

  std::span<const Vector3d> positions_;
  double min_cos_ = 1.0;
  std::vector<Vector3d> rays_{};      ///< in the world
  std::vector<uint32_t> by_place_{};  ///< indices of correspondences
  std::vector<Place> places_{};
};

Places PlacesOf(const Rigid3& pose,
                const SceneCorrespondences& correspondences,
                double max_error_rad) {
  return PlaceCounter(pose.rotation, correspondences, max_error_rad).At(pose.Centre());
}

Rigid3 Refine(Rigid3 pose, const SceneCorrespondences& correspondences, double max_error_rad) {
  for (int round = 0; round < kMaxRounds; ++round) {
    const double limit_rad = round == 0 ? kPairSlack * max_error_rad : max_error_rad;
    const PoseSupport support = SupportOf(pose, correspondences, limit_rad);
    pose = RefineAbsolutePose(pose,
                              correspondences.bearings,
                              correspondences.positions,
                              support.is_inlier,
                              max_error_rad);
  }
  return pose;
}

}  // namespace

Rigid3 PoseOfMostPlaces(const Rigid3& found,
                        const SceneCorrespondences& correspondences,
                        std::span<const ViewMatches> views,
                        double max_error_rad) {
  const PlaceCounter counter(found.rotation, correspondences, kPairSlack * max_error_rad);
  Vector3d best = found.Centre();
  const size_t needed = counter.CountAt(best);
  size_t most = needed;
  for (const ViewMatches& view : views.first(std::min(views.size(), kMaxViews))) {
    const Vector3d start = view.view_from_world.Centre();
    const Vector3d step = found.Centre() - start;
    if (step.norm() > 0.0) counter.FindBest(start, step.normalized(), best, most);
  }
  if (most == needed) return found;
  const Rigid3 refined =
      Refine(Rigid3::FromCentre(found.rotation, best), correspondences, max_error_rad);
  const size_t places = PlacesOf(refined, correspondences, max_error_rad).count();
  return places > PlacesOf(found, correspondences, max_error_rad).count() ? refined : found;
}

PlaceCount CountPlaces(const Rigid3& pose,
                       const SceneCorrespondences& correspondences,
                       double max_error_rad) {
  Places seen;
  for (const Vector3d& bearing : correspondences.bearings)
    seen.set(SphereCell(bearing, kSpreadCells));
  return {seen.count(), PlacesOf(pose, correspondences, max_error_rad).count()};
}

std::optional<Rigid3> CandidateOfMostPlaces(std::span<const Rigid3> candidates,
                                            const SceneCorrespondences& correspondences,
                                            double max_error_rad) {
  const Rigid3* best = nullptr;
  size_t most = 0;
  for (const Rigid3& candidate : candidates) {
    const size_t places = PlacesOf(candidate, correspondences, kPairSlack * max_error_rad).count();
    if (best != nullptr && places <= most) continue;
    most = places;
    best = &candidate;
  }
  if (best == nullptr) return std::nullopt;
  return Refine(*best, correspondences, max_error_rad);
}

bool HasClearlyMorePlaces(const Rigid3& x,
                          const Rigid3& y,
                          const SceneCorrespondences& correspondences,
                          double max_error_rad) {
  constexpr double kDeviations = 2.0;
  if (x.translation == y.translation && x.rotation.coeffs() == y.rotation.coeffs()) return false;
  const Places of_x = PlacesOf(x, correspondences, max_error_rad);
  const Places of_y = PlacesOf(y, correspondences, max_error_rad);
  const auto x_alone = static_cast<double>((of_x & ~of_y).count());
  const auto y_alone = static_cast<double>((of_y & ~of_x).count());
  return x_alone - y_alone > kDeviations * std::sqrt(x_alone + y_alone);
}

}  // namespace orbweave
