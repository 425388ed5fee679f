// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/assess_world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bundle/pose_covariance.h"
#include "core/merging/georeference/gnss_variance.h"

namespace orbweave {
namespace {

struct WorldTotals {
  double sum_of_squares = 0.0;
  double weighted_sum_of_squares = 0.0;
  double redundancy = 0.0;
  TrackCorrelation correlation{};
  std::optional<ImageId> held{};
  std::optional<ImageId> farthest{};
};

WorldTotals TotalsOf(const std::vector<SubproblemInspection>& subproblems) {
  WorldTotals totals;
  for (const SubproblemInspection& subproblem : subproblems) {
    totals.sum_of_squares += subproblem.sum_of_squares;
    totals.weighted_sum_of_squares += subproblem.weighted_sum_of_squares;
    totals.redundancy += subproblem.redundancy;
    totals.correlation.Add(subproblem.correlation);
    if (subproblem.held) totals.held = subproblem.held;
    if (subproblem.farthest) totals.farthest = subproblem.farthest;
  }
  return totals;
}

/// By what the bearings of images say less of their poses than their number and scatter claim, on
/// average (SupportVerdict::coherence).
double MeanCoherence(const std::map<ImageId, SupportVerdict>& supports) {
  if (supports.empty()) return 1.0;
  double sum = 0.0;
  for (const auto& [id, verdict] : supports) sum += std::max(verdict.coherence, 1.0);
  return sum / static_cast<double>(supports.size());
}

SeparatorSystem SumOfBearings(std::vector<SubproblemInspection> subproblems) {
  std::vector<SeparatorSystem> systems;
  for (SubproblemInspection& subproblem : subproblems)
    systems.push_back(std::move(subproblem.bearings));
  return AddSystems(systems);
}

SeparatorSystem WithoutPoints(SeparatorSystem sum) {
  std::vector<SeparatorId> poses;
  for (const SeparatorId& id : sum.variables) {
    if (id.kind == SeparatorId::Kind::kPose) poses.push_back(id);
  }
  if (poses.size() == sum.variables.size()) return sum;
  return EliminateSeparators(sum, poses, kUnheldPointDamping);
}

/// By how much more than those of an average image the errors of an image's own bearings move it,
/// all other poses as they are: variance S_ii^-1 times the difference of factors. Of images where
/// that is more.
std::map<ImageId, Block6> CovariancesBeyondMean(const SeparatorSystem& bearings,
                                                const std::map<ImageId, SupportVerdict>& supports,
                                                double mean_coherence,
                                                double bearing_factor) {
  std::map<ImageId, Block6> beyond;
  const SymmetricBlockMatrix& S = bearings.normal.S;
  for (uint32_t j = 0; j < S.num_blocks; ++j) {
    const auto support = supports.find(ImageId(bearings.variables[j].index));
    if (support == supports.end() || support->second.coherence <= mean_coherence) continue;
    const Eigen::LDLT<Block6> block(S.values[S.Find({j, j})].selfadjointView<Eigen::Upper>());
    if (block.info() != Eigen::Success || !block.isPositive()) continue;
    const Block6 inverse = block.solve(Block6::Identity());
    const double more = bearing_factor * (support->second.coherence - mean_coherence);
    if (inverse.allFinite()) beyond[support->first] = more * inverse;
  }
  return beyond;
}

/// A world's poses as variables of one problem.
class PoseSystem {
 public:
  PoseSystem(const GlobalProblem& problem,
             const std::vector<Eigen::Vector3d>& biases_m,
             const SeparatorSystem& bearings)
      : problem_(problem), state_(InitialState(problem.bundle)) {
    state_.biases = biases_m;
    gauge_.pose_is_held.assign(problem.image_of_pose.size(), 1);
    for (const SeparatorId& id : bearings.variables)
      gauge_.pose_is_held[PoseOf(ImageId(id.index))] = 0;
  }

  void Hold(std::optional<ImageId> held, std::optional<ImageId> farthest) {
    if (held) gauge_.anchor = PoseOf(*held);
    if (held && farthest) gauge_.farthest = PoseOf(*farthest);
  }

  [[nodiscard]] PoseCovariances Covariances(SeparatorSystem bearings,
                                            const VarianceFactors& factors) const {
    const BundleLayout layout = MakeBundleLayout(problem_.bundle, gauge_);
    ReducedSystem system = SystemOf(bearings, layout);
    bearings = {};  // as large as the system
    return CovariancesOfSystem(
        {problem_.bundle, layout, state_, gauge_}, factors, std::move(system));
  }

  [[nodiscard]] const BundleState& state() const { return state_; }
  [[nodiscard]] bool IsVariable(size_t pose) const { return gauge_.pose_is_held[pose] == 0; }

 private:
  [[nodiscard]] uint32_t PoseOf(ImageId id) const {
    return static_cast<uint32_t>(std::ranges::lower_bound(problem_.image_of_pose, id) -
                                 problem_.image_of_pose.begin());
  }

  [[nodiscard]] ReducedSystem SystemOf(const SeparatorSystem& bearings,
                                       const BundleLayout& layout) const {
    std::vector<uint32_t> block_of_variable;
    for (const SeparatorId& id : bearings.variables)
      block_of_variable.push_back(layout.pose_block[PoseOf(ImageId(id.index))]);
    ReducedSystem system = MakeReducedSystem(layout);
    system.S = UnionPattern(layout.matrix, bearings.normal.S, block_of_variable);
    const SymmetricBlockMatrix& S = bearings.normal.S;
    for (uint32_t j = 0; j < S.num_blocks; ++j) {
      system.trace[block_of_variable[j]] = bearings.normal.trace[j];
      for (uint32_t p = S.column_start[j]; p < S.column_start[j + 1]; ++p) {
        const BlockIndex at{block_of_variable[j], block_of_variable[S.rows[p]]};
        system.S.values[system.S.Find(at)] += S.values[p];
      }
    }
    return system;
  }

  // Poses ascend in both, so that upper triangles stay upper.
  static SymmetricBlockMatrix UnionPattern(const SymmetricBlockMatrix& x,
                                           const SymmetricBlockMatrix& y,
                                           const std::vector<uint32_t>& x_of_y) {
    std::vector<BlockIndex> pattern;
    for (uint32_t j = 0; j < x.num_blocks; ++j) {
      for (uint32_t p = x.column_start[j]; p < x.column_start[j + 1]; ++p)
        pattern.push_back({j, x.rows[p]});
    }
    for (uint32_t j = 0; j < y.num_blocks; ++j) {
      for (uint32_t p = y.column_start[j]; p < y.column_start[j + 1]; ++p)
        pattern.push_back({x_of_y[j], x_of_y[y.rows[p]]});
    }
    return MakeBlockMatrix(x.num_blocks, std::move(pattern));
  }

  const GlobalProblem& problem_;
  BundleState state_;
  Gauge gauge_{};
};

PoseUncertainty FromCovariance(const Block6& covariance) {
  const double rotation_variance = covariance.topLeftCorner<3, 3>().trace();
  return {.position_covariance = covariance.bottomRightCorner<3, 3>(),
          .rotation_sigma_rad = std::sqrt(std::max(rotation_variance, 0.0))};
}

/// Degrees of freedom of the world that bearings alone leave open and that something else holds.
double GaugeFreedoms(const GlobalProblem& problem, bool holds_distance) {
  if (!problem.bundle.position_priors.empty()) return 7.0;
  return holds_distance ? 1.0 : 0.0;  // the held pose is no variable
}

}  // namespace

AssessedWorld AssessWorld(std::vector<SubproblemInspection> subproblems,
                          const std::map<ImageId, SupportVerdict>& supports,
                          const GlobalProblem& problem,
                          const std::vector<Eigen::Vector3d>& biases_m,
                          const ImageManifest& manifest) {
  AssessedWorld assessed;
  const WorldTotals totals = TotalsOf(subproblems);
  SeparatorSystem sum = SumOfBearings(std::move(subproblems));
  const auto num_split = static_cast<double>(
      std::ranges::count(sum.variables, SeparatorId::Kind::kPoint, &SeparatorId::kind));
  SeparatorSystem bearings = WithoutPoints(std::move(sum));
  if (!bearings.is_definite || bearings.variables.empty()) {
    assessed.report.reason = "the normal equations of the poses are not positive definite";
    return assessed;
  }
  PoseSystem poses(problem, biases_m, bearings);
  poses.Hold(totals.held, totals.farthest);
  const double redundancy = totals.redundancy +
                            GaugeFreedoms(problem, totals.farthest.has_value()) - 3.0 * num_split -
                            6.0 * static_cast<double>(bearings.variables.size());
  const double bearing_factor = totals.correlation.Inflation() *
                                BearingVarianceFactor(totals.weighted_sum_of_squares, redundancy);
  const double coherence = MeanCoherence(supports);
  const std::map<ImageId, Block6> beyond_mean =
      CovariancesBeyondMean(bearings, supports, coherence, bearing_factor);
  const PoseCovariances covariances =
      poses.Covariances(std::move(bearings),
                        {.bearings = coherence * bearing_factor,
                         .positions = EstimateGnssVariance(problem, biases_m, manifest).factors});
  UncertaintyReport& report = assessed.report;
  report.reason = covariances.reason;
  report.known = covariances.reason.empty();
  if (totals.held) report.held_image = manifest.At(*totals.held).name;
  if (totals.farthest) report.held_distance_to = manifest.At(*totals.farthest).name;
  report.bearing_sigma_factor = std::sqrt(BearingVarianceFactor(totals.sum_of_squares, redundancy));
  report.horizontal_gnss_sigma_factor = std::sqrt(covariances.factors.positions.x());
  report.vertical_gnss_sigma_factor = std::sqrt(covariances.factors.positions.z());
  for (size_t pose = 0; pose < problem.image_of_pose.size(); ++pose) {
    const ImageId id = problem.image_of_pose[pose];
    const bool is_known = poses.IsVariable(pose) || id == totals.held;
    if (!is_known || !covariances.poses[pose]) continue;
    Block6 covariance = *covariances.poses[pose];
    if (const auto more = beyond_mean.find(id); more != beyond_mean.end())
      covariance += more->second;
    assessed.uncertainties[id] = FromCovariance(covariance);
  }
  return assessed;
}

}  // namespace orbweave
