// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/gauge.h"

#include <algorithm>

namespace orbweave {
namespace {

std::vector<uint8_t> PosesThatObserve(const BundleProblem& problem) {
  std::vector<uint8_t> observes(problem.cams_from_world.size(), 0);
  for (const BundleObservation& observation : problem.observations) observes[observation.pose] = 1;
  return observes;
}

std::optional<uint32_t> FirstSet(const std::vector<uint8_t>& flags) {
  const auto it = std::find(flags.begin(), flags.end(), uint8_t{1});
  if (it == flags.end()) return std::nullopt;
  return static_cast<uint32_t>(it - flags.begin());
}

std::optional<uint32_t> FarthestFrom(uint32_t anchor,
                                     const std::vector<uint8_t>& observes,
                                     const BundleProblem& problem) {
  const Eigen::Vector3d centre = problem.cams_from_world[anchor].Centre();
  std::optional<uint32_t> farthest;
  double largest = 0.0;
  for (uint32_t i = 0; i < problem.cams_from_world.size(); ++i) {
    const double distance = (problem.cams_from_world[i].Centre() - centre).norm();
    if (!observes[i] || i == anchor || distance <= largest) continue;
    largest = distance;
    farthest = i;
  }
  return farthest;
}

}  // namespace

Gauge ChooseGauge(const BundleProblem& problem) {
  Gauge gauge;
  gauge.pose_is_held = problem.pose_is_fixed;
  gauge.pose_is_held.resize(problem.cams_from_world.size(), 0);
  const auto num_fixed = std::count_if(gauge.pose_is_held.begin(),
                                       gauge.pose_is_held.end(),
                                       [](uint8_t fixed) { return fixed != 0; });
  const bool any_fixed_point = std::any_of(problem.point_is_fixed.begin(),
                                           problem.point_is_fixed.end(),
                                           [](uint8_t fixed) { return fixed != 0; });
  if (num_fixed >= 2 || any_fixed_point || !problem.position_priors.empty()) return gauge;

  const std::vector<uint8_t> observes = PosesThatObserve(problem);
  gauge.anchor = num_fixed == 1 ? FirstSet(gauge.pose_is_held) : FirstSet(observes);
  if (!gauge.anchor) return gauge;
  gauge.pose_is_held[*gauge.anchor] = 1;
  gauge.farthest = FarthestFrom(*gauge.anchor, observes, problem);
  gauge.pose_scales = observes;
  gauge.pose_scales[*gauge.anchor] = 0;
  gauge.point_scales.assign(problem.points_in_world.size(), 0);
  for (const BundleObservation& seen : problem.observations) gauge.point_scales[seen.point] = 1;
  return gauge;
}

double HeldDistance(const Gauge& gauge, const BundleProblem& problem) {
  if (!gauge.farthest) return 0.0;
  return (problem.cams_from_world[*gauge.farthest].Centre() -
          problem.cams_from_world[*gauge.anchor].Centre())
      .norm();
}

void RestoreScale(const Gauge& gauge, double distance, BundleProblem& problem) {
  const double now = HeldDistance(gauge, problem);
  if (now > 0.0) ScaleAboutAnchor(gauge, distance / now, problem);
}

void ScaleAboutAnchor(const Gauge& gauge, double scale, BundleProblem& problem) {
  if (scale == 1.0) return;
  const Eigen::Vector3d centre = problem.cams_from_world[*gauge.anchor].Centre();
  for (size_t i = 0; i < problem.cams_from_world.size(); ++i) {
    if (!gauge.pose_scales[i]) continue;
    Rigid3& cam_from_world = problem.cams_from_world[i];
    cam_from_world = Rigid3::FromCentre(cam_from_world.rotation,
                                        centre + scale * (cam_from_world.Centre() - centre));
  }
  for (size_t i = 0; i < problem.points_in_world.size(); ++i) {
    Eigen::Vector3d& point = problem.points_in_world[i];
    if (gauge.point_scales[i]) point = centre + scale * (point - centre);
  }
}

}  // namespace orbweave
