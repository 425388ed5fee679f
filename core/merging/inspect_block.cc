// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/merging/inspect_block.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "core/bundle/adjust_bundle.h"
#include "core/bundle/bundle_eliminator.h"
#include "core/merging/scene_lean.h"
#include "core/merging/terms_of_block.h"

namespace orbweave {
namespace {

/// A block's bearings alone: priors are weighted anew when the whole world is known.
AdjustmentBlock BearingsOf(const WorldBlock& block) {
  AdjustmentBlock terms = TermsOf(block);
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

/// Redundancy of what the block as a whole is taken to know of a panorama's scatter before looking
/// at it: as much as two poses' unknowns, so that a handful of errors does not pass for a sigma.
constexpr double kPriorRedundancy = 12.0;
constexpr double kMinFactor = 1e-4;  // exact data, as in VarianceFactors

/// A-posteriori over claimed variance of the bearings of each image of the block: its own squares
/// over its own redundancy, drawn to the block's mean where they are few.
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

void WeighByScatter(const std::map<ImageId, double>& scatter, AdjustmentBlock& terms) {
  for (BundleObservation& seen : terms.problem.observations) {
    const auto found = scatter.find(ImageId(terms.pose_ids[seen.pose]));
    if (found != scatter.end()) seen.sigma_rad *= std::sqrt(found->second);
  }
}

/// Variables that stay: poses that see something, and split points.
struct Kept {
  KeptVariables local{};
  std::vector<SeparatorId> ids{};
};

Kept KeptOf(const WorldBlock& block, const AdjustmentBlock& terms) {
  Kept kept;
  for (uint32_t pose = 0; pose < terms.pose_ids.size(); ++pose) {
    if (terms.gauge.pose_is_held[pose] != 0) continue;
    kept.local.poses.push_back(pose);
    kept.ids.push_back({SeparatorId::Kind::kPose, terms.pose_ids[pose]});
  }
  for (uint32_t i = 0; i < block.split.size(); ++i) {
    kept.local.points.push_back(i);
    kept.ids.push_back({SeparatorId::Kind::kPoint, block.split[i].id});
  }
  return kept;
}

/// Two equations per observation, less the unknowns of points that are eliminated.
double RedundancyOf(const WorldBlock& block) {
  double redundancy = 0.0;
  for (const Track& track : block.scene.tracks)
    redundancy += 2.0 * static_cast<double>(track.observations.size()) - 3.0;
  for (const SplitTrack& track : block.split)
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

TrackCorrelation CorrelationOf(const WorldBlock& block) {
  TrackCorrelation correlation;
  for (const Track& track : block.scene.tracks) {
    std::vector<Eigen::Vector3d> residuals;
    for (const Observation& seen : track.observations) {
      const Rigid3& pose = block.scene.images.at(seen.ref.image).cam_from_world;
      const Eigen::Vector3d ray = (track.point_in_world - pose.Centre()).normalized();
      residuals.emplace_back((pose.rotation.conjugate() * seen.bearing - ray) / seen.sigma_rad);
    }
    correlation.AddTrack(residuals);
  }
  return correlation;
}

double SquaresOf(const WorldBlock& block) {
  double sum = 0.0;
  for (const Track& track : block.scene.tracks) sum += SquaresOf(track, block.scene);
  for (const SplitTrack& track : block.split) sum += SquaresOf(track.part, block.scene);
  return sum;
}

void AddBearings(const WorldBlock& block, int num_threads, BlockInspection& inspection) {
  AdjustmentBlock terms = BearingsOf(block);
  WeighByScatter(ScatterOfImages(inspection.supports), terms);
  const Kept kept = KeptOf(block, terms);
  BundleEliminator eliminator(
      terms.problem, terms.gauge, kept.local, {.loss = BundleLoss::kLeastSquares}, num_threads);
  const EvaluatedState state = eliminator.Start();
  inspection.sum_of_squares = SquaresOf(block);
  inspection.weighted_sum_of_squares = 2.0 * eliminator.Cost(state);
  inspection.redundancy = RedundancyOf(block);
  SeparatorSystem& system = inspection.bearings;
  system.is_definite = eliminator.Linearize(state, {.lambda = kUnheldPointDamping});
  if (!system.is_definite) return;
  system.variables = kept.ids;
  system.normal = eliminator.Remaining();
}

}  // namespace

BlockInspection InspectBlock(const WorldBlock& block, int num_threads) {
  BlockInspection inspection{.farthest = block.farthest,
                             .placements = PlaceBySides(block),
                             .supports = SupportOf(block),
                             .correlation = CorrelationOf(block)};
  inspection.points_about = PointsAboutPanoramas(block);
  AddBearings(block, num_threads, inspection);
  const auto held = std::ranges::find_if(block.images, &BlockImage::is_held);
  if (held != block.images.end()) inspection.held = held->id;
  return inspection;
}

}  // namespace orbweave
