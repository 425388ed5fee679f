// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/adjust_block.h"

#include <numbers>
#include <utility>

#include "core/base/status.h"
#include "core/merging/filter_block.h"
#include "core/merging/terms_of_block.h"

namespace orbweave {
namespace {

void AddTrack(const Track& track,
              const std::map<ImageId, EquirectangularCamera>& cameras,
              const Reconstruction& scene,
              BlockSummary& summary) {
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

BlockSummary Summarise(const WorldBlock& block) {
  BlockSummary summary{.cluster = block.cluster, .biases = block.biases};
  std::map<ImageId, EquirectangularCamera> cameras;
  for (const BlockImage& image : block.images) {
    cameras[image.id] = image.camera;
    if (block.Owns(image)) summary.owned_images[image.id] = block.scene.images.at(image.id);
  }
  for (const Track& track : block.scene.tracks) AddTrack(track, cameras, block.scene, summary);
  for (const SplitTrack& track : block.split) AddTrack(track.part, cameras, block.scene, summary);
  return summary;
}

}  // namespace

BlockWorker::BlockWorker(WorldBlock block,
                         std::optional<EvaluatedState> state,
                         const BlockOptions& options,
                         int num_threads)
    : block_(std::move(block)), options_(options), num_threads_(num_threads) {
  if (!state) return;
  state_ = *std::move(state);
  trial_ = state_;
}

BlockAnswer BlockWorker::Execute(const BlockOrder& order) {
  BlockAnswer answer;
  TakeState(order);
  switch (order.work) {
    case BlockOrder::Work::kBegin:
      Begin(order, answer);
      break;
    case BlockOrder::Work::kLinearise:
      Linearise(order);
      answer.system = *system_;
      break;
    case BlockOrder::Work::kTry: {
      if (!system_ || control_ != order.control) Linearise(order);
      BlockTrial trial = solver_->BackSubstitute(state_, order.step);
      trial_ = std::move(trial.state);
      answer.trial = std::move(trial.cost);
      is_trial_ = true;
      break;
    }
    case BlockOrder::Work::kFilter:
      Filter(state_.variables, answer);
      if (order.begins_again) Begin(order, answer);
      break;
  }
  return answer;
}

BundleOptions BlockWorker::BundleFor(const BlockOrder& order) const {
  BundleOptions bundle = options_.bundle;
  bundle.loss = order.loss;
  return bundle;
}

BlockAnswer BlockWorker::TakeOver(const BundleProblem& solved,
                                  const std::vector<Eigen::Vector3d>& biases_m) {
  BundleState state{.points = solved.points_in_world, .biases = biases_m};
  for (const Rigid3& cam_from_world : solved.cams_from_world) {
    state.poses.push_back({.rotation = cam_from_world.rotation, .centre = cam_from_world.Centre()});
  }
  BlockAnswer answer;
  Filter(state, answer);
  return answer;
}

void BlockWorker::TakeState(const BlockOrder& order) {
  is_trial_ = false;
  if (order.work == BlockOrder::Work::kBegin) return;
  if (!terms_) terms_ = std::make_unique<AdjustmentBlock>(TermsOf(block_));
  if (!order.takes_trial) return;
  state_ = Accepted(*terms_, std::move(trial_), order.shortened);
  system_.reset();
}

void BlockWorker::Begin(const BlockOrder& order, BlockAnswer& answer) {
  terms_ = std::make_unique<AdjustmentBlock>(TermsOf(block_));
  solver_ = std::make_unique<BlockSolver>(*terms_, BundleFor(order), num_threads_);
  BlockTrial start = solver_->Start();
  state_ = std::move(start.state);
  answer.cost = start.cost.cost;
  answer.separators = terms_->separators;
  answer.num_observations = terms_->problem.observations.size();
  Linearise(order);
  answer.system = *system_;
}

void BlockWorker::Linearise(const BlockOrder& order) {
  if (!solver_) solver_ = std::make_unique<BlockSolver>(*terms_, BundleFor(order), num_threads_);
  system_ = solver_->Linearize(state_, order.control);
  control_ = order.control;
}

void BlockWorker::Filter(const BundleState& state, BlockAnswer& answer) {
  solver_.reset();
  system_.reset();
  FilteredBlock filtered = FilterBlock(WithState(std::move(block_), state),
                                       options_.max_error_px,
                                       options_.min_angle_deg * std::numbers::pi / 180.0);
  block_ = std::move(filtered.block);
  terms_ = std::make_unique<AdjustmentBlock>(TermsOf(block_));
  answer.removed_observations = filtered.removed_observations;
  answer.removed_tracks = filtered.removed_tracks;
  answer.summary = Summarise(block_);
}

}  // namespace orbweave
