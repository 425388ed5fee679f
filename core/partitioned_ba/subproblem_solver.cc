// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/subproblem_solver.h"

#include <numbers>
#include <utility>

#include "core/base/status.h"
#include "core/bundle/bearing_error.h"
#include "core/partitioned_ba/filter_subproblem.h"
#include "core/partitioned_ba/terms_of_subproblem.h"

namespace orbweave {
namespace {

void AddTrack(const Track& track,
              const std::map<ImageId, EquirectangularCamera>& cameras,
              const Reconstruction& scene,
              SubproblemSummary& summary) {
  for (const Observation& seen : track.observations) {
    const Rigid3& pose = scene.images.at(seen.ref.image).cam_from_world;
    const double error_px =
        cameras.at(seen.ref.image)
            .PixelsFromAngle(BearingError(pose, track.point_in_world, seen.bearing));
    summary.residual_px_sum += error_px;
    summary.residual_px2_sum += error_px * error_px;
    summary.pattern.Add(seen.bearing,
                        (pose * track.point_in_world).normalized(),
                        cameras.at(seen.ref.image).PixelsFromAngle(1.0));
    ++summary.observations_of_image[seen.ref.image];
  }
}

SubproblemSummary Summarise(const Subproblem& subproblem) {
  SubproblemSummary summary{.cluster = subproblem.cluster, .biases = subproblem.biases};
  std::map<ImageId, EquirectangularCamera> cameras;
  for (const SubproblemImage& image : subproblem.images) {
    cameras[image.id] = image.camera;
    if (subproblem.Owns(image))
      summary.owned_images[image.id] = subproblem.scene.images.at(image.id);
  }
  for (const Track& track : subproblem.scene.tracks)
    AddTrack(track, cameras, subproblem.scene, summary);
  for (const SplitTrack& track : subproblem.split)
    AddTrack(track.part, cameras, subproblem.scene, summary);
  return summary;
}

}  // namespace

SubproblemSolver::SubproblemSolver(Subproblem subproblem,
                                   std::optional<EvaluatedState> state,
                                   const SubproblemOptions& options,
                                   int num_threads)
    : subproblem_(std::move(subproblem)), options_(options), num_threads_(num_threads) {
  if (!state) return;
  state_ = *std::move(state);
  trial_ = state_;
}

LmReply SubproblemSolver::Execute(const LmRequest& request) {
  LmReply reply;
  TakeState(request);
  switch (request.work) {
    case LmRequest::Work::kEvaluate:
      Evaluate(request, reply);
      break;
    case LmRequest::Work::kLinearise:
      Linearise(request);
      reply.system = *system_;
      break;
    case LmRequest::Work::kTrial: {
      if (!system_ || control_ != request.control) Linearise(request);
      SubproblemTrial trial = solver_->BackSubstitute(state_, request.step);
      trial_ = std::move(trial.state);
      reply.trial = std::move(trial.cost);
      is_trial_ = true;
      break;
    }
    case LmRequest::Work::kFilter:
      Filter(state_.variables, reply);
      if (request.evaluates_again) Evaluate(request, reply);
      break;
  }
  return reply;
}

BundleOptions SubproblemSolver::BundleFor(const LmRequest& request) const {
  BundleOptions bundle = options_.bundle;
  bundle.loss = request.loss;
  return bundle;
}

LmReply SubproblemSolver::TakeOver(const BundleProblem& solved,
                                   const std::vector<Eigen::Vector3d>& biases_m) {
  BundleState state{.points = solved.points_in_world, .biases = biases_m};
  for (const Rigid3& cam_from_world : solved.cams_from_world) {
    state.poses.push_back({.rotation = cam_from_world.rotation, .centre = cam_from_world.Centre()});
  }
  LmReply reply;
  Filter(state, reply);
  return reply;
}

void SubproblemSolver::TakeState(const LmRequest& request) {
  is_trial_ = false;
  if (request.work == LmRequest::Work::kEvaluate) return;
  if (!terms_) terms_ = std::make_unique<BundleSubproblem>(TermsOf(subproblem_));
  if (!request.takes_trial) return;
  state_ = Accepted(*terms_, std::move(trial_), request.shortened);
  system_.reset();
}

void SubproblemSolver::Evaluate(const LmRequest& request, LmReply& reply) {
  terms_ = std::make_unique<BundleSubproblem>(TermsOf(subproblem_));
  solver_ = std::make_unique<SubproblemEliminator>(*terms_, BundleFor(request), num_threads_);
  SubproblemTrial start = solver_->Start();
  state_ = std::move(start.state);
  reply.cost = start.cost.cost;
  reply.separators = terms_->separators;
  reply.num_observations = terms_->problem.observations.size();
  Linearise(request);
  reply.system = *system_;
}

void SubproblemSolver::Linearise(const LmRequest& request) {
  if (!solver_)
    solver_ = std::make_unique<SubproblemEliminator>(*terms_, BundleFor(request), num_threads_);
  system_ = solver_->Linearise(state_, request.control);
  control_ = request.control;
}

void SubproblemSolver::Filter(const BundleState& state, LmReply& reply) {
  solver_.reset();
  system_.reset();
  FilteredSubproblem filtered = FilterSubproblem(WithState(std::move(subproblem_), state),
                                                 options_.max_error_px,
                                                 options_.min_angle_deg * std::numbers::pi / 180.0);
  subproblem_ = std::move(filtered.subproblem);
  terms_ = std::make_unique<BundleSubproblem>(TermsOf(subproblem_));
  reply.removed_observations = filtered.removed_observations;
  reply.removed_tracks = filtered.removed_tracks;
  reply.summary = Summarise(subproblem_);
}

}  // namespace orbweave
