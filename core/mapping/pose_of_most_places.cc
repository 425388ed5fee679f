// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/pose_of_most_places.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <vector>

#include "core/estimators/estimate_absolute_pose.h"
#include "core/geometry/sphere_cells.h"
#include "core/mapping/baseline_length.h"
#include "core/mapping/pair_witness.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kMaxViews = 5;
constexpr size_t kMaxLengths = 100;  ///< per view that are tried
constexpr int kMaxRounds = 3;        ///< of refinement

using Places = std::bitset<static_cast<size_t>(kSpreadCells) * kSpreadCells>;

Places PlacesOf(const Rigid3& pose,
                const SceneCorrespondences& correspondences,
                double max_error_rad) {
  const PoseSupport support = SupportOf(pose, correspondences, max_error_rad);
  Places places;
  for (size_t i = 0; i < correspondences.size(); ++i) {
    if (support.is_inlier[i] != 0)
      places.set(SphereCell(correspondences.bearings[i], kSpreadCells));
  }
  return places;
}

size_t CountPlaces(const Rigid3& pose,
                   const SceneCorrespondences& correspondences,
                   double max_error_rad) {
  return PlacesOf(pose, correspondences, max_error_rad).count();
}

/// Poses with the rotation of `found` on the ray from `start` through its centre.
std::vector<Rigid3> PosesAlong(const Vector3d& start,
                               const Rigid3& found,
                               const SceneCorrespondences& correspondences) {
  std::vector<Rigid3> poses;
  const Vector3d step = found.Centre() - start;
  if (step.norm() == 0.0) return poses;
  const Vector3d direction = step.normalized();
  const size_t stride =
      std::max<size_t>(1, (correspondences.size() + kMaxLengths - 1) / kMaxLengths);
  for (size_t i = 0; i < correspondences.size(); i += stride) {
    const double s = BaselineLength(correspondences.positions[i] - start,
                                    direction,
                                    found.rotation.conjugate() * correspondences.bearings[i]);
    if (s > 0.0) poses.push_back(Rigid3::FromCentre(found.rotation, start + s * direction));
  }
  return poses;
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
  const double slack_rad = kPairSlack * max_error_rad;
  Rigid3 best = found;
  const size_t needed = CountPlaces(found, correspondences, slack_rad);
  size_t most = needed;
  for (const ViewMatches& view : views.first(std::min(views.size(), kMaxViews))) {
    for (const Rigid3& pose : PosesAlong(view.view_from_world.Centre(), found, correspondences)) {
      const size_t places = CountPlaces(pose, correspondences, slack_rad);
      if (places <= most) continue;
      most = places;
      best = pose;
    }
  }
  if (most == needed) return found;
  const Rigid3 refined = Refine(best, correspondences, max_error_rad);
  return CountPlaces(refined, correspondences, max_error_rad) >
                 CountPlaces(found, correspondences, max_error_rad)
             ? refined
             : found;
}

bool HasClearlyMorePlaces(const Rigid3& x,
                          const Rigid3& y,
                          const SceneCorrespondences& correspondences,
                          double max_error_rad) {
  constexpr double kDeviations = 2.0;
  const Places of_x = PlacesOf(x, correspondences, max_error_rad);
  const Places of_y = PlacesOf(y, correspondences, max_error_rad);
  const auto x_alone = static_cast<double>((of_x & ~of_y).count());
  const auto y_alone = static_cast<double>((of_y & ~of_x).count());
  return x_alone - y_alone > kDeviations * std::sqrt(x_alone + y_alone);
}

}  // namespace orbweave
