// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/merging/checks/inspect_subproblem.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "core/bundle/bearing_error.h"
#include "core/bundle/bundle_eliminator.h"
#include "core/merging/georeference/scene_lean.h"
#include "core/partitioned_ba/terms_of_subproblem.h"

namespace orbweave {
namespace {

/// A subproblem's bearings alone: priors are weighted anew when the whole world is known.
BundleSubproblem BearingsOf(const Subproblem& subproblem) {
  BundleSubproblem terms = TermsOf(subproblem);
  terms.problem.position_priors.clear();
  terms.problem.direction_priors.clear();
  terms.problem.bias_sigma_m.clear();
  terms.gauge.anchor.reset();
  terms.gauge.farthest.reset();
  std::vector<uint8_t> observes(terms.pose_ids.size(), 0);
  for (const BundleObservation& seen : terms.problem.observations) observes[seen.pose] = 1;
  for (size_t pose = 0; pose < observes.size(); ++pose) {
    if (observes[pose] == 0) terms.gauge.pose_is_held[pose] = 1;  // no variable
  }
  return terms;
}

/// Redundancy of what the subproblem as a whole is taken to know of a panorama's scatter before
/// looking at it: as much as two poses' unknowns, so that a handful of errors does not pass for a
/// sigma.
constexpr double kPriorRedundancy = 12.0;
constexpr double kMinFactor = 1e-4;  // exact data, as in VarianceFactors

/// A-posteriori over claimed variance of the bearings of each image of the subproblem: its own
/// squares over its own redundancy, drawn to the subproblem's mean where they are few.
std::map<ImageId, double> ScatterOfImages(const std::vector<PatchSupport>& supports) {
  struct Sum {
    double squares = 0.0;
    double redundancy = 0.0;
  };
  std::map<ImageId, Sum> of_image;
  Sum all;
  for (const PatchSupport& support : supports) {
    for (Sum* sum : {&of_image[support.image], &all}) {
      sum->squares += support.sum_of_squares;
      sum->redundancy += support.redundancy;
    }
  }
  all.redundancy -= 6.0 * static_cast<double>(of_image.size());
  const double mean = all.redundancy < 1.0 ? 1.0 : all.squares / all.redundancy;
  std::map<ImageId, double> scatter;
  for (const auto& [id, sum] : of_image) {
    const double redundancy = std::max(sum.redundancy - 6.0, 0.0) + kPriorRedundancy;
    const double squares = sum.redundancy > 6.0 ? sum.squares : 0.0;
    scatter[id] = std::max((squares + kPriorRedundancy * mean) / redundancy, kMinFactor);
  }
  return scatter;
}

void WeighByScatter(const std::map<ImageId, double>& scatter, BundleSubproblem& terms) {
  for (BundleObservation& seen : terms.problem.observations) {
    const auto found = scatter.find(ImageId(terms.pose_ids[seen.pose]));
    if (found != scatter.end()) seen.sigma_rad *= std::sqrt(found->second);
  }
}

/// Variables that stay: poses that see something, and split points.
struct Kept {
  RetainedVariables local{};
  std::vector<SeparatorId> ids{};
};

Kept KeptOf(const Subproblem& subproblem, const BundleSubproblem& terms) {
  Kept retained;
  for (uint32_t pose = 0; pose < terms.pose_ids.size(); ++pose) {
    if (terms.gauge.pose_is_held[pose] != 0) continue;
    retained.local.poses.push_back(pose);
    retained.ids.push_back({SeparatorId::Kind::kPose, terms.pose_ids[pose]});
  }
  for (uint32_t i = 0; i < subproblem.split.size(); ++i) {
    retained.local.points.push_back(i);
    retained.ids.push_back({SeparatorId::Kind::kPoint, subproblem.split[i].id});
  }
  return retained;
}

/// Two equations per observation, less the unknowns of points that are eliminated.
double RedundancyOf(const Subproblem& subproblem) {
  double redundancy = 0.0;
  for (const Track& track : subproblem.scene.tracks)
    redundancy += 2.0 * static_cast<double>(track.observations.size()) - 3.0;
  for (const SplitTrack& track : subproblem.split)
    redundancy += 2.0 * static_cast<double>(track.part.observations.size());
  return redundancy;
}

double SquaresOf(const Track& track, const Reconstruction& scene) {
  double sum = 0.0;
  for (const Observation& seen : track.observations) {
    const double error =
        BearingError(
            scene.images.at(seen.ref.image).cam_from_world, track.point_in_world, seen.bearing) /
        seen.sigma_rad;
    sum += error * error;
  }
  return sum;
}

TrackCorrelation CorrelationOf(const Subproblem& subproblem) {
  TrackCorrelation correlation;
  for (const Track& track : subproblem.scene.tracks) {
    std::vector<Eigen::Vector3d> residuals;
    for (const Observation& seen : track.observations) {
      const Rigid3& pose = subproblem.scene.images.at(seen.ref.image).cam_from_world;
      const Eigen::Vector3d ray = (track.point_in_world - pose.Centre()).normalized();
      residuals.emplace_back((pose.rotation.conjugate() * seen.bearing - ray) / seen.sigma_rad);
    }
    correlation.AddTrack(residuals);
  }
  return correlation;
}

double SquaresOf(const Subproblem& subproblem) {
  double sum = 0.0;
  for (const Track& track : subproblem.scene.tracks) sum += SquaresOf(track, subproblem.scene);
  for (const SplitTrack& track : subproblem.split) sum += SquaresOf(track.part, subproblem.scene);
  return sum;
}

void AddBearings(const Subproblem& subproblem, int num_threads, SubproblemInspection& inspection) {
  BundleSubproblem terms = BearingsOf(subproblem);
  WeighByScatter(ScatterOfImages(inspection.supports), terms);
  const Kept retained = KeptOf(subproblem, terms);
  BundleEliminator eliminator(
      terms.problem, terms.gauge, retained.local, {.loss = BundleLoss::kLeastSquares}, num_threads);
  const EvaluatedState state = eliminator.Start();
  inspection.sum_of_squares = SquaresOf(subproblem);
  inspection.weighted_sum_of_squares = 2.0 * eliminator.Cost(state);
  inspection.redundancy = RedundancyOf(subproblem);
  SeparatorSystem& system = inspection.bearings;
  system.is_definite = eliminator.Linearise(state, {.lambda = kUnheldPointDamping});
  if (!system.is_definite) return;
  system.variables = retained.ids;
  system.normal = eliminator.Remaining();
}

}  // namespace

SubproblemInspection InspectSubproblem(const Subproblem& subproblem, int num_threads) {
  SubproblemInspection inspection{.farthest = subproblem.farthest,
                                  .placements = PlaceBySides(subproblem),
                                  .supports = SupportOf(subproblem),
                                  .correlation = CorrelationOf(subproblem)};
  inspection.points_about = PointsAboutPanoramas(subproblem);
  inspection.seen_between = CountSeenBetween(subproblem);
  AddBearings(subproblem, num_threads, inspection);
  const auto held = std::ranges::find_if(subproblem.images, &SubproblemImage::is_held);
  if (held != subproblem.images.end()) inspection.held = held->id;
  return inspection;
}

}  // namespace orbweave
