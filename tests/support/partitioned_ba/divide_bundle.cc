// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/partitioned_ba/divide_bundle.h"

#include <algorithm>
#include <limits>

#include "tests/support/partitioned_ba/divide_terms.h"

namespace orbweave {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

// Indices of a whole problem in the order of a subproblem.
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

// How many subproblems use each variable of the whole problem.
struct UseCounts {
  std::vector<uint32_t> poses{};
  std::vector<uint32_t> biases{};
  std::vector<uint32_t> points{};
};

// Copies terms into subproblems; its workspaces serve one subproblem after the other.
class SubproblemMaker {
 public:
  SubproblemMaker(const BundleProblem& problem, const Gauge& gauge)
      : problem_(problem),
        gauge_(gauge),
        poses_(problem.cams_from_world.size()),
        points_(problem.points_in_world.size()),
        biases_(problem.bias_sigma_m.size()) {}

  BundleSubproblem Make(const SubproblemTerms& terms, const std::vector<uint32_t>& idle_poses) {
    for (const uint32_t pose : idle_poses) poses_.Use(pose);
    UseVariables(terms);
    BundleSubproblem subproblem{
        .pose_ids = poses_.Number(), .point_ids = points_.Number(), .bias_ids = biases_.Number()};
    CopyVariables(terms, subproblem);
    CopyTerms(terms, subproblem.problem);
    CopyGauge(subproblem);
    poses_.Clear();
    points_.Clear();
    biases_.Clear();
    return subproblem;
  }

 private:
  void UseVariables(const SubproblemTerms& terms) {
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

  void CopyVariables(const SubproblemTerms& terms, BundleSubproblem& subproblem) const {
    BundleProblem& local = subproblem.problem;
    for (const uint32_t pose : subproblem.pose_ids) {
      local.cams_from_world.push_back(problem_.cams_from_world[pose]);
    }
    for (const uint32_t point : subproblem.point_ids) {
      local.points_in_world.push_back(problem_.points_in_world[point]);
      if (problem_.point_is_fixed.empty()) continue;
      local.point_is_fixed.push_back(problem_.point_is_fixed[point]);
    }
    for (const uint32_t group : subproblem.bias_ids) {
      const double sigma_m = problem_.bias_sigma_m[group];
      const bool counts_here =
          std::binary_search(terms.bias_priors.begin(), terms.bias_priors.end(), group);
      local.bias_sigma_m.push_back(
          counts_here || !(sigma_m > 0.0) ? sigma_m : std::numeric_limits<double>::infinity());
    }
  }

  void CopyTerms(const SubproblemTerms& terms, BundleProblem& local) const {
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

  void CopyGauge(BundleSubproblem& subproblem) const {
    Gauge& gauge = subproblem.gauge;
    for (const uint32_t pose : subproblem.pose_ids) {
      gauge.pose_is_held.push_back(gauge_.pose_is_held[pose]);
      if (!gauge_.pose_scales.empty()) gauge.pose_scales.push_back(gauge_.pose_scales[pose]);
    }
    for (const uint32_t point : subproblem.point_ids) {
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
                                             uint32_t num_subproblems) {
  std::vector<uint8_t> is_idle(problem.cams_from_world.size(), 1);
  for (const BundleObservation& seen : problem.observations) is_idle[seen.pose] = 0;
  for (const PositionPrior& prior : problem.position_priors) is_idle[prior.pose] = 0;
  for (const DirectionPrior& prior : problem.direction_priors) is_idle[prior.pose] = 0;
  std::vector<std::vector<uint32_t>> idle(num_subproblems);
  for (uint32_t pose = 0; pose < is_idle.size(); ++pose) {
    if (is_idle[pose] && !gauge.pose_is_held[pose]) idle[owner_of_pose[pose]].push_back(pose);
  }
  return idle;
}

UseCounts CountUses(const BundleProblem& problem,
                    const std::vector<BundleSubproblem>& subproblems) {
  UseCounts counts;
  counts.poses.assign(problem.cams_from_world.size(), 0);
  counts.biases.assign(problem.bias_sigma_m.size(), 0);
  counts.points.assign(problem.points_in_world.size(), 0);
  for (const BundleSubproblem& subproblem : subproblems) {
    for (const uint32_t pose : subproblem.pose_ids) ++counts.poses[pose];
    for (const uint32_t group : subproblem.bias_ids) ++counts.biases[group];
    for (const uint32_t point : subproblem.point_ids) ++counts.points[point];
  }
  return counts;
}

void FindSeparators(const UseCounts& counts, BundleSubproblem& subproblem) {
  const BundleProblem& local = subproblem.problem;
  for (size_t i = 0; i < subproblem.pose_ids.size(); ++i) {
    const uint32_t pose = subproblem.pose_ids[i];
    if (counts.poses[pose] < 2 || subproblem.gauge.pose_is_held[i]) continue;
    subproblem.separators.push_back({SeparatorId::Kind::kPose, pose});
  }
  for (size_t i = 0; i < subproblem.bias_ids.size(); ++i) {
    const uint32_t group = subproblem.bias_ids[i];
    if (counts.biases[group] < 2 || !(local.bias_sigma_m[i] > 0.0)) continue;
    subproblem.separators.push_back({SeparatorId::Kind::kBias, group});
  }
  for (size_t i = 0; i < subproblem.point_ids.size(); ++i) {
    const uint32_t point = subproblem.point_ids[i];
    const bool is_fixed = !local.point_is_fixed.empty() && local.point_is_fixed[i] != 0;
    if (counts.points[point] < 2 || is_fixed) continue;
    subproblem.separators.push_back({SeparatorId::Kind::kPoint, point});
  }
}

}  // namespace

std::vector<BundleSubproblem> DivideBundle(const BundleProblem& problem,
                                           const std::vector<uint32_t>& owner_of_pose,
                                           uint32_t num_subproblems) {
  const Gauge gauge = ChooseGauge(problem);
  const std::vector<SubproblemTerms> terms =
      DivideTerms(problem, gauge, owner_of_pose, num_subproblems);
  const std::vector<std::vector<uint32_t>> idle =
      IdlePoses(problem, gauge, owner_of_pose, num_subproblems);
  SubproblemMaker maker(problem, gauge);
  std::vector<BundleSubproblem> subproblems;
  for (uint32_t b = 0; b < num_subproblems; ++b)
    subproblems.push_back(maker.Make(terms[b], idle[b]));
  const UseCounts counts = CountUses(problem, subproblems);
  for (BundleSubproblem& subproblem : subproblems) FindSeparators(counts, subproblem);
  return subproblems;
}

void GatherBundle(const std::vector<BundleSubproblem>& subproblems, BundleProblem& problem) {
  for (const BundleSubproblem& subproblem : subproblems) {
    for (size_t i = 0; i < subproblem.pose_ids.size(); ++i) {
      problem.cams_from_world[subproblem.pose_ids[i]] = subproblem.problem.cams_from_world[i];
    }
    for (size_t i = 0; i < subproblem.point_ids.size(); ++i) {
      problem.points_in_world[subproblem.point_ids[i]] = subproblem.problem.points_in_world[i];
    }
  }
}

}  // namespace orbweave
