// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/distributed_bundle/block_solver.h"
#include "core/merging/residual_pattern.h"
#include "core/merging/world_block.h"

namespace orbweave {

/// What a block is asked to do next. Equal blocks, states and orders give equal answers, whoever
/// computes them.
struct BlockOrder {
  enum class Work : uint8_t {
    kBegin,      ///< evaluate the block's own poses and points, linearise there
    kLinearise,  ///< linearise at the state
    kTry,        ///< after kLinearise at the same state: a step of the separators
    kFilter,     ///< take the state over into the block, remove bad observations
  };
  Work work = Work::kBegin;
  /// The state is the one that the last kTry led to, with these points shortened.
  bool takes_trial = false;
  std::vector<ShortenedPoint> shortened{};
  StepControl control{};
  SeparatorStep step{};       ///< kTry: of the block's separators
  bool begins_again = false;  ///< kFilter: then as kBegin
  BundleLoss loss = BundleLoss::kCauchy;
};

/// How a block does what it is asked for, the same for all orders. `bundle.loss` is the order's.
struct BlockOptions {
  BundleOptions bundle{};
  double max_error_px = 4.0;
  double min_angle_deg = 1.5;
};

/// A filtered block without its tracks.
struct BlockSummary {
  uint32_t cluster = 0;
  std::map<ImageId, RegisteredImage> owned_images{};
  std::map<ImageId, uint32_t> observations_of_image{};  ///< in this block, of any of its images
  std::vector<BlockBias> biases{};
  double residual_px_sum = 0.0;  ///< angle x W / 2pi, over observations
  double residual_px2_sum = 0.0;
  ResidualPattern pattern{};
};

struct BlockAnswer {
  /// kBegin.
  std::vector<SeparatorId> separators{};
  double cost = 0.0;
  uint64_t num_observations = 0;
  SeparatorSystem system{};  ///< kBegin, kLinearise
  TrialCost trial{};         ///< kTry
  /// kFilter.
  uint32_t removed_observations = 0;
  uint32_t removed_tracks = 0;
  BlockSummary summary{};
};

/// A block at work. Holds its linearisation between kLinearise and kTry; one made anew from the
/// block and its state computes it again, to the same bytes.
class BlockWorker {
 public:
  /// `state`: of a worker that is taken up in the middle; nullopt: before kBegin.
  BlockWorker(WorldBlock block,
              std::optional<EvaluatedState> state,
              const BlockOptions& options,
              int num_threads);

  [[nodiscard]] BlockAnswer Execute(const BlockOrder& order);

  /// As kFilter, with poses, points and biases that another solver found.
  [[nodiscard]] BlockAnswer TakeOver(const BundleProblem& solved,
                                     const std::vector<Eigen::Vector3d>& biases_m);

  [[nodiscard]] const WorldBlock& block() const { return block_; }
  [[nodiscard]] size_t num_observations() const {
    return terms_ ? terms_->problem.observations.size() : 0;
  }
  [[nodiscard]] WorldBlock TakeBlock() { return std::move(block_); }
  /// After kBegin, kLinearise: the state. After kTry: the state it led to.
  [[nodiscard]] const EvaluatedState& state() const { return is_trial_ ? trial_ : state_; }

 private:
  void TakeState(const BlockOrder& order);
  void Begin(const BlockOrder& order, BlockAnswer& answer);
  void Linearise(const BlockOrder& order);
  void Filter(const BundleState& state, BlockAnswer& answer);

  [[nodiscard]] BundleOptions BundleFor(const BlockOrder& order) const;

  WorldBlock block_;
  BlockOptions options_;
  int num_threads_;
  EvaluatedState state_{};
  EvaluatedState trial_{};
  bool is_trial_ = false;
  std::unique_ptr<AdjustmentBlock> terms_;
  std::unique_ptr<BlockSolver> solver_;
  std::optional<SeparatorSystem> system_;  // of the last linearisation at state_ ...
  StepControl control_{};                  // ... with this
};

}  // namespace orbweave
