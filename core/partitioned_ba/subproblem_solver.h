// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/partitioned_ba/residual_pattern.h"
#include "core/partitioned_ba/subproblem.h"
#include "core/partitioned_ba/subproblem_eliminator.h"

namespace orbweave {

/// What a subproblem is asked to do next. Equal subproblems, states and requests give equal
/// replies, whoever computes them.
struct LmRequest {
  enum class Work : uint8_t {
    kEvaluate,   ///< evaluate the subproblem's own poses and points, linearise there
    kLinearise,  ///< linearise at the state
    kTrial,      ///< after kLinearise at the same state: a step of the separators
    kFilter,     ///< take the state over into the subproblem, remove bad observations
  };
  Work work = Work::kEvaluate;
  /// The state is the one that the last kTrial led to, with these points shortened.
  bool takes_trial = false;
  std::vector<ShortenedPoint> shortened{};
  StepControl control{};
  SeparatorStep step{};          ///< kTrial: of the subproblem's separators
  bool evaluates_again = false;  ///< kFilter: then as kEvaluate
  BundleLoss loss = BundleLoss::kCauchy;
};

/// How a subproblem does what it is asked for, the same for all requests. `bundle.loss` is the
/// request's.
struct SubproblemOptions {
  BundleOptions bundle{};
  double max_error_px = 4.0;
  double min_angle_deg = 1.5;
};

/// A filtered subproblem without its tracks.
struct SubproblemSummary {
  uint32_t cluster = 0;
  std::map<ImageId, RegisteredImage> owned_images{};
  std::map<ImageId, uint32_t>
      observations_of_image{};  ///< in this subproblem, of any of its images
  std::vector<SubproblemBias> biases{};
  double residual_px_sum = 0.0;  ///< angle x W / 2pi, over observations
  double residual_px2_sum = 0.0;
  ResidualPattern pattern{};
};

struct LmReply {
  /// kEvaluate.
  std::vector<SeparatorId> separators{};
  double cost = 0.0;
  uint64_t num_observations = 0;
  SeparatorSystem system{};  ///< kEvaluate, kLinearise
  TrialCost trial{};         ///< kTrial
  /// kFilter.
  uint32_t removed_observations = 0;
  uint32_t removed_tracks = 0;
  SubproblemSummary summary{};
};

/// A subproblem at work. Holds its linearisation between kLinearise and kTrial; one made anew from
/// the subproblem and its state computes it again, to the same bytes.
class SubproblemSolver {
 public:
  /// `state`: of a worker that is taken up in the middle; nullopt: before kEvaluate.
  SubproblemSolver(Subproblem subproblem,
                   std::optional<EvaluatedState> state,
                   const SubproblemOptions& options,
                   int num_threads);

  [[nodiscard]] LmReply Execute(const LmRequest& request);

  /// As kFilter, with poses, points and biases that another solver found.
  [[nodiscard]] LmReply TakeOver(const BundleProblem& solved,
                                 const std::vector<Eigen::Vector3d>& biases_m);

  [[nodiscard]] const Subproblem& subproblem() const { return subproblem_; }
  [[nodiscard]] size_t num_observations() const {
    return terms_ ? terms_->problem.observations.size() : 0;
  }
  [[nodiscard]] Subproblem TakeSubproblem() { return std::move(subproblem_); }
  /// After kEvaluate, kLinearise: the state. After kTrial: the state it led to.
  [[nodiscard]] const EvaluatedState& state() const { return is_trial_ ? trial_ : state_; }

 private:
  void TakeState(const LmRequest& request);
  void Evaluate(const LmRequest& request, LmReply& reply);
  void Linearise(const LmRequest& request);
  void Filter(const BundleState& state, LmReply& reply);

  [[nodiscard]] BundleOptions BundleFor(const LmRequest& request) const;

  Subproblem subproblem_;
  SubproblemOptions options_;
  int num_threads_;
  EvaluatedState state_{};
  EvaluatedState trial_{};
  bool is_trial_ = false;
  std::unique_ptr<BundleSubproblem> terms_;
  std::unique_ptr<SubproblemEliminator> solver_;
  std::optional<SeparatorSystem> system_;  // of the last linearisation at state_ ...
  StepControl control_{};                  // ... with this
};

}  // namespace orbweave
