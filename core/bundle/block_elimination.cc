// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/block_elimination.h"

#include <utility>

namespace orbweave {
namespace {

std::vector<uint32_t> Indices(const std::vector<uint8_t>& is_set) {
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < is_set.size(); ++i) {
    if (is_set[i]) indices.push_back(i);
  }
  return indices;
}

std::vector<uint8_t> Filled(std::vector<uint8_t> flags, uint32_t size) {
  flags.resize(size, 0);
  return flags;
}

}  // namespace

BlockElimination::BlockElimination(const SymmetricBlockMatrix& pattern,
                                   std::vector<uint8_t> is_retained)
    : is_retained_(Filled(std::move(is_retained), pattern.num_blocks)),
      retained_(Indices(is_retained_)),
      cholesky_(pattern, is_retained_) {}

bool BlockElimination::Eliminate(double lambda, NormalSystem& system) {
  DampPoses(lambda, system, is_retained_);
  if (!cholesky_.Factorize(system.S)) return false;
  forward_ = system.rhs;
  cholesky_.SolveForward(forward_);
  return true;
}

NormalSystem BlockElimination::Remaining(const NormalSystem& system) const {
  NormalSystem remaining = MakeNormalSystem(cholesky_.Remaining());
  for (size_t i = 0; i < retained_.size(); ++i) {
    remaining.rhs[i] = forward_[retained_[i]];
    remaining.gradient[i] = system.gradient[retained_[i]];
    remaining.trace[i] = system.trace[retained_[i]];
  }
  return remaining;
}

std::vector<Vector6> BlockElimination::BackSubstitute(
    const std::vector<Vector6>& retained_step) const {
  std::vector<Vector6> step = forward_;
  for (size_t i = 0; i < retained_.size(); ++i) step[retained_[i]] = retained_step[i];
  cholesky_.SolveBackward(step);
  return step;
}

double BlockElimination::PredictedDecrease(const NormalSystem& system,
                                           const std::vector<Vector6>& step) const {
  double decrease = 0.0;
  for (size_t block = 0; block < step.size(); ++block) {
    if (is_retained_[block]) continue;
    decrease += 0.5 * (system.damping[block].dot(step[block].cwiseAbs2()) -
                       system.gradient[block].dot(step[block]));
  }
  return decrease;
}

}  // namespace orbweave
