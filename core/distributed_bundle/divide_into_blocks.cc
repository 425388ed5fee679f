// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/distributed_bundle/divide_into_blocks.h"

#include <algorithm>
#include <limits>

#include "core/distributed_bundle/block_terms.h"

namespace orbweave {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

// Indices of a whole problem in the order of a block.
class LocalIndices {
 public:
  explicit LocalIndices(size_t size) : local_(size, kNone) {}

  void Use(uint32_t index) {
    if (local_[index] != kNone) return;
    local_[index] = 0;
    used_.push_back(index);
  }
  /// Numbers what was used in ascending order.
  [[nodiscard]] const std::vector<uint32_t>& Number() {
    std::sort(used_.begin(), used_.end());
    for (uint32_t i = 0; i < used_.size(); ++i) local_[used_[i]] = i;
    return used_;
  }
  [[nodiscard]] uint32_t operator[](uint32_t index) const { return local_[index]; }
  [[nodiscard]] bool IsUsed(uint32_t index) const { return local_[index] != kNone; }
  void Clear() {
    for (const uint32_t index : used_) local_[index] = kNone;
    used_.clear();
  }

 private:
  std::vector<uint32_t> local_;
  std::vector<uint32_t> used_{};
};

// How many blocks use each variable of the whole problem.
struct UseCounts {
  std::vector<uint32_t> poses{};
  std::vector<uint32_t> biases{};
  std::vector<uint32_t> points{};
};

// Copies terms into blocks; its workspaces serve one block after the other.
class BlockMaker {
 public:
  BlockMaker(const BundleProblem& problem, const Gauge& gauge)
      : problem_(problem),
        gauge_(gauge),
        poses_(problem.cams_from_world.size()),
        points_(problem.points_in_world.size()),
        biases_(problem.bias_sigma_m.size()) {}

  AdjustmentBlock Make(const BlockTerms& terms, const std::vector<uint32_t>& idle_poses) {
    for (const uint32_t pose : idle_poses) poses_.Use(pose);
    UseVariables(terms);
    AdjustmentBlock block{
        .pose_ids = poses_.Number(), .point_ids = points_.Number(), .bias_ids = biases_.Number()};
    CopyVariables(terms, block);
    CopyTerms(terms, block.problem);
    CopyGauge(block);
    poses_.Clear();
    points_.Clear();
    biases_.Clear();
    return block;
  }

 private:
  void UseVariables(const BlockTerms& terms) {
    if (gauge_.farthest) poses_.Use(*gauge_.anchor);
    for (const uint32_t i : terms.observations) {
      poses_.Use(problem_.observations[i].pose);
      points_.Use(problem_.observations[i].point);
    }
    for (const uint32_t i : terms.position_priors) {
      const PositionPrior& prior = problem_.position_priors[i];
      poses_.Use(prior.pose);
      if (prior.bias_group) biases_.Use(*prior.bias_group);
    }
    for (const uint32_t i : terms.direction_priors) poses_.Use(problem_.direction_priors[i].pose);
    for (const uint32_t group : terms.bias_priors) biases_.Use(group);
  }

  void CopyVariables(const BlockTerms& terms, AdjustmentBlock& block) const {
    BundleProblem& local = block.problem;
    for (const uint32_t pose : block.pose_ids) {
      local.cams_from_world.push_back(problem_.cams_from_world[pose]);
    }
    for (const uint32_t point : block.point_ids) {
      local.points_in_world.push_back(problem_.points_in_world[point]);
      if (problem_.point_is_fixed.empty()) continue;
      local.point_is_fixed.push_back(problem_.point_is_fixed[point]);
    }
    for (const uint32_t group : block.bias_ids) {
      const double sigma_m = problem_.bias_sigma_m[group];
      const bool counts_here =
          std::binary_search(terms.bias_priors.begin(), terms.bias_priors.end(), group);
      local.bias_sigma_m.push_back(
          counts_here || !(sigma_m > 0.0) ? sigma_m : std::numeric_limits<double>::infinity());
    }
  }

  void CopyTerms(const BlockTerms& terms, BundleProblem& local) const {
    for (const uint32_t i : terms.observations) {
      BundleObservation& seen = local.observations.emplace_back(problem_.observations[i]);
      seen.pose = poses_[seen.pose];
      seen.point = points_[seen.point];
    }
    for (const uint32_t i : terms.position_priors) {
      PositionPrior& prior = local.position_priors.emplace_back(problem_.position_priors[i]);
      prior.pose = poses_[prior.pose];
      if (prior.bias_group) prior.bias_group = biases_[*prior.bias_group];
    }
    for (const uint32_t i : terms.direction_priors) {
      DirectionPrior& prior = local.direction_priors.emplace_back(problem_.direction_priors[i]);
      prior.pose = poses_[prior.pose];
    }
  }

  void CopyGauge(AdjustmentBlock& block) const {
    Gauge& gauge = block.gauge;
    for (const uint32_t pose : block.pose_ids) {
      gauge.pose_is_held.push_back(gauge_.pose_is_held[pose]);
      if (!gauge_.pose_scales.empty()) gauge.pose_scales.push_back(gauge_.pose_scales[pose]);
    }
    for (const uint32_t point : block.point_ids) {
      if (!gauge_.point_scales.empty()) gauge.point_scales.push_back(gauge_.point_scales[point]);
    }
    if (!gauge_.farthest) return;
    gauge.anchor = poses_[*gauge_.anchor];
    if (poses_.IsUsed(*gauge_.farthest)) gauge.farthest = poses_[*gauge_.farthest];
  }

  const BundleProblem& problem_;
  const Gauge& gauge_;
  LocalIndices poses_;
  LocalIndices points_;
  LocalIndices biases_;
};

// The free poses that no term uses, by owner.
std::vector<std::vector<uint32_t>> IdlePoses(const BundleProblem& problem,
                                             const Gauge& gauge,
                                             const std::vector<uint32_t>& owner_of_pose,
                                             uint32_t num_blocks) {
  std::vector<uint8_t> is_idle(problem.cams_from_world.size(), 1);
  for (const BundleObservation& seen : problem.observations) is_idle[seen.pose] = 0;
  for (const PositionPrior& prior : problem.position_priors) is_idle[prior.pose] = 0;
  for (const DirectionPrior& prior : problem.direction_priors) is_idle[prior.pose] = 0;
  std::vector<std::vector<uint32_t>> idle(num_blocks);
  for (uint32_t pose = 0; pose < is_idle.size(); ++pose) {
    if (is_idle[pose] && !gauge.pose_is_held[pose]) idle[owner_of_pose[pose]].push_back(pose);
  }
  return idle;
}

UseCounts CountUses(const BundleProblem& problem, const std::vector<AdjustmentBlock>& blocks) {
  UseCounts counts;
  counts.poses.assign(problem.cams_from_world.size(), 0);
  counts.biases.assign(problem.bias_sigma_m.size(), 0);
  counts.points.assign(problem.points_in_world.size(), 0);
  for (const AdjustmentBlock& block : blocks) {
    for (const uint32_t pose : block.pose_ids) ++counts.poses[pose];
    for (const uint32_t group : block.bias_ids) ++counts.biases[group];
    for (const uint32_t point : block.point_ids) ++counts.points[point];
  }
  return counts;
}

void FindSeparators(const UseCounts& counts, AdjustmentBlock& block) {
  const BundleProblem& local = block.problem;
  for (size_t i = 0; i < block.pose_ids.size(); ++i) {
    const uint32_t pose = block.pose_ids[i];
    if (counts.poses[pose] < 2 || block.gauge.pose_is_held[i]) continue;
    block.separators.push_back({SeparatorId::Kind::kPose, pose});
  }
  for (size_t i = 0; i < block.bias_ids.size(); ++i) {
    const uint32_t group = block.bias_ids[i];
    if (counts.biases[group] < 2 || !(local.bias_sigma_m[i] > 0.0)) continue;
    block.separators.push_back({SeparatorId::Kind::kBias, group});
  }
  for (size_t i = 0; i < block.point_ids.size(); ++i) {
    const uint32_t point = block.point_ids[i];
    const bool is_fixed = !local.point_is_fixed.empty() && local.point_is_fixed[i] != 0;
    if (counts.points[point] < 2 || is_fixed) continue;
    block.separators.push_back({SeparatorId::Kind::kPoint, point});
  }
}

}  // namespace

std::vector<AdjustmentBlock> DivideIntoBlocks(const BundleProblem& problem,
                                              const std::vector<uint32_t>& owner_of_pose,
                                              uint32_t num_blocks) {
  const Gauge gauge = ChooseGauge(problem);
  const std::vector<BlockTerms> terms = DivideTerms(problem, gauge, owner_of_pose, num_blocks);
  const std::vector<std::vector<uint32_t>> idle =
      IdlePoses(problem, gauge, owner_of_pose, num_blocks);
  BlockMaker maker(problem, gauge);
  std::vector<AdjustmentBlock> blocks;
  for (uint32_t b = 0; b < num_blocks; ++b) blocks.push_back(maker.Make(terms[b], idle[b]));
  const UseCounts counts = CountUses(problem, blocks);
  for (AdjustmentBlock& block : blocks) FindSeparators(counts, block);
  return blocks;
}

void GatherBlocks(const std::vector<AdjustmentBlock>& blocks, BundleProblem& problem) {
  for (const AdjustmentBlock& block : blocks) {
    for (size_t i = 0; i < block.pose_ids.size(); ++i) {
      problem.cams_from_world[block.pose_ids[i]] = block.problem.cams_from_world[i];
    }
    for (size_t i = 0; i < block.point_ids.size(); ++i) {
      problem.points_in_world[block.point_ids[i]] = block.problem.points_in_world[i];
    }
  }
}

}  // namespace orbweave
