// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/sights.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kMaxSigmas = 3.0;
constexpr double kFarSight = 0.25;

/// Horizontally; nullopt where a position is missing.
std::optional<Vector3d> StepBetweenPositions(const ClusterProblem& problem, const Sight& sight) {
  const PosePrior& a = problem.images[sight.a].prior;
  const PosePrior& b = problem.images[sight.b].prior;
  if (!a.position_in_enu || !b.position_in_enu) return std::nullopt;
  Vector3d step = *b.position_in_enu - *a.position_in_enu;
  step.z() = 0.0;  // drives may have origins of their own
  return step;
}

/// Sights of each image, as indices.
std::vector<std::vector<size_t>> SightsOfImages(size_t num_images,
                                                const std::vector<Sight>& sights) {
  std::vector<std::vector<size_t>> of_image(num_images);
  for (size_t s = 0; s < sights.size(); ++s) {
    of_image[sights[s].a].push_back(s);
    of_image[sights[s].b].push_back(s);
  }
  return of_image;
}

/// The sights of most inliers of each image, of all and of those that lead the other way: the next
/// images to either side. Ascending.
std::vector<size_t> FindSteps(const std::vector<Sight>& sights,
                              const std::vector<std::vector<size_t>>& of_image) {
  constexpr double kOtherWay = -0.5;
  std::vector<size_t> steps;
  for (ImageSlot image = 0; image < of_image.size(); ++image) {
    const auto away = [&](size_t s) -> Vector3d {
      return sights[s].a == image ? sights[s].direction : Vector3d(-sights[s].direction);
    };
    const auto append_strongest = [&](const auto& counts) {
      size_t strongest = sights.size();
      for (const size_t s : of_image[image]) {
        if (counts(s) &&
            (strongest == sights.size() || sights[s].num_inliers > sights[strongest].num_inliers))
          strongest = s;
      }
      if (strongest < sights.size()) steps.push_back(strongest);
    };
    if (of_image[image].empty()) continue;
    append_strongest([](size_t) { return true; });
    const Vector3d there = away(steps.back());
    append_strongest([&](size_t s) { return away(s).dot(there) < kOtherWay; });
  }
  std::ranges::sort(steps);
  const auto [from, to] = std::ranges::unique(steps);
  steps.erase(from, to);
  return steps;
}

/// Sights of places that look alike have few inliers beside those of steps.
void Weigh(std::span<const size_t> steps, std::vector<Sight>& sights) {
  std::vector<double> counts;
  for (const size_t s : steps) counts.push_back(sights[s].num_inliers);
  const double usual = Quantile(counts, 0.5);
  for (Sight& sight : sights) sight.weight = 2.0 * sight.num_inliers / (sight.num_inliers + usual);
}

}  // namespace

std::vector<Sight> SightsOf(const ClusterProblem& problem,
                            const PairDirections& pairs,
                            const Eigen::Quaterniond& enu_from_world) {
  std::vector<Sight> sights;
  for (size_t e = 0; e < pairs.edges.size(); ++e) {
    sights.push_back({pairs.edges[e].pair.a.value,
                      pairs.edges[e].pair.b.value,
                      (enu_from_world * pairs.Direction(e)).normalized(),
                      pairs.edges[e].num_inliers});
  }
  GuessLengthsOfSteps(
      problem, [](ImageSlot) { return true; }, sights);
  return sights;
}

void GuessLengthsOfSteps(const ClusterProblem& problem,
                         const std::function<bool(ImageSlot)>& counts,
                         std::vector<Sight>& sights) {
  const auto of_image = SightsOfImages(problem.images.size(), sights);
  const std::vector<size_t> steps = FindSteps(sights, of_image);
  if (steps.empty()) return;
  Weigh(steps, sights);
  std::vector<std::vector<double>> lengths_about(problem.images.size());
  for (const size_t s : steps) {
    const std::optional<Vector3d> step = StepBetweenPositions(problem, sights[s]);
    if (!step || !counts(sights[s].a) || !counts(sights[s].b)) continue;
    for (const ImageSlot end : {sights[s].a, sights[s].b}) {
      for (const size_t about : of_image[end]) {
        lengths_about[sights[about].a].push_back(step->norm());
        lengths_about[sights[about].b].push_back(step->norm());
      }
    }
  }
  for (Sight& sight : sights) sight.length_m = 0.0;
  for (const size_t s : steps) {
    std::vector<double> about = lengths_about[sights[s].a];
    const std::vector<double>& more = lengths_about[sights[s].b];
    about.insert(about.end(), more.begin(), more.end());
    if (!about.empty()) sights[s].length_m = Quantile(about, 0.5);
  }
}

SightsBesidePositions::SightsBesidePositions(const ClusterProblem& problem,
                                             const std::vector<Sight>& sights)
    : problem_(problem), sights_(sights), is_trusted_(problem.images.size(), 0) {
  for (size_t i = 0; i < problem.images.size(); ++i)
    is_trusted_[i] = problem.images[i].prior.position_in_enu ? 1 : 0;
  while (DistrustTheWorst()) continue;
}

bool SightsBesidePositions::Fits(const Sight& sight) const {
  return !IsTrusted(sight.a) || !IsTrusted(sight.b) || Agrees(sight);
}

bool SightsBesidePositions::Agrees(const Sight& sight) const {
  const double sigma_m =
      kLeastScatter * std::hypot(problem_.images[sight.a].prior.horizontal_sigma_m,
                                 problem_.images[sight.b].prior.horizontal_sigma_m);
  const Vector3d step = *StepBetweenPositions(problem_, sight);
  const Vector3d level = Vector3d(sight.direction.x(), sight.direction.y(), 0.0).normalized();
  const double along_m = level.dot(step);
  if (along_m < -kMaxSigmas * sigma_m) return false;
  if ((step - along_m * level).norm() > kMaxSigmas * sigma_m) return false;
  return sight.length_m == 0.0 || std::abs(along_m - sight.length_m) <=
                                      kMaxSigmas * std::hypot(sigma_m, kStepShare * sight.length_m);
}

bool SightsBesidePositions::DistrustTheWorst() {
  std::vector<double> all(is_trusted_.size(), 0.0);
  std::vector<double> against(is_trusted_.size(), 0.0);
  for (const Sight& sight : sights_) {
    if (!IsTrusted(sight.a) || !IsTrusted(sight.b)) continue;
    const double weight = (sight.length_m > 0.0 ? 1.0 : kFarSight) * sight.weight;
    for (const ImageSlot image : {sight.a, sight.b}) {
      all[image] += weight;
      if (!Agrees(sight)) against[image] += weight;
    }
  }
  size_t worst = 0;
  double worst_share = 0.5;
  for (size_t i = 0; i < all.size(); ++i) {
    if (against[i] <= worst_share * all[i]) continue;
    worst = i;
    worst_share = against[i] / all[i];
  }
  if (worst_share <= 0.5) return false;
  is_trusted_[worst] = 0;
  return true;
}

}  // namespace orbweave
