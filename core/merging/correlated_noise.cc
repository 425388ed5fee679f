// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/correlated_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

// Shares are dense where they matter: an inflation of 2 takes 5 % of a long correlation.
constexpr std::array<double, 11> kShares = {
    0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 1.0};
constexpr double kLengthStep = 1.7;
// Errors longer than the way are an offset of all positions, which none of them shows.
constexpr double kLongest = 2.0;  // of the longest run
// Receivers state their sigma to a factor of two or so: log(2^2).
constexpr double kClaimedLogVariance = 1.4;
constexpr double kLeastVariance = 1e-12;

struct Hypothesis {
  double share = 0.0;
  double length = 1.0;
};

struct Evidence {
  double log_likelihood = 0.0;
  double variance = 0.0;  // sigma^2
};

// What one run and hypothesis add: X and r whitened by the Kalman filter of the process.
class Whitening {
 public:
  Whitening(Eigen::Index num_unknowns) : normal_(num_unknowns + 1, num_unknowns + 1) {
    normal_.setZero();
  }

  void Add(const NoiseRun& run, const Hypothesis& hypothesis) {
    const Eigen::Index p = run.design.cols();
    Eigen::VectorXd state = Eigen::VectorXd::Zero(p + 1);  // of each column, and of the residuals
    double state_variance = hypothesis.share;
    Eigen::VectorXd row(p + 1);
    for (size_t i = 0; i < run.places.size(); ++i) {
      if (i > 0) {
        const double kept = std::exp(-(run.places[i] - run.places[i - 1]) / hypothesis.length);
        state *= kept;
        state_variance = kept * kept * state_variance + (1.0 - kept * kept) * hypothesis.share;
      }
      const auto at = static_cast<Eigen::Index>(i);
      row << run.design.row(at).transpose(), run.residuals[at];
      row -= state;
      const double variance = std::max(state_variance + 1.0 - hypothesis.share, kLeastVariance);
      state += state_variance / variance * row;
      state_variance -= state_variance * state_variance / variance;
      normal_.noalias() += row * row.transpose() / variance;
      log_determinant_ += std::log(variance);
      ++count_;
    }
  }

  // nullopt-like variance 0 where the unknowns cannot be told.
  [[nodiscard]] Evidence Finish(const Eigen::VectorXd& information) const {
    const Eigen::Index p = information.size();
    Eigen::MatrixXd A = normal_.topLeftCorner(p, p);
    A.diagonal() += information;
    const Eigen::LLT<Eigen::MatrixXd> cholesky(A);
    if (cholesky.info() != Eigen::Success) return {};
    const Eigen::VectorXd b = normal_.topRightCorner(p, 1);
    const double squares = normal_(p, p) - b.dot(cholesky.solve(b));
    const double redundancy = static_cast<double>(count_ - p);
    const double variance = std::max(squares / redundancy, kLeastVariance);
    const double log_determinant_of_A = 2.0 * cholesky.matrixLLT().diagonal().array().log().sum();
    const double surprise = std::log(variance) / kClaimedLogVariance;
    return {.log_likelihood = -0.5 * (redundancy * std::log(variance) + log_determinant_ +
                                      log_determinant_of_A + surprise * surprise),
            .variance = variance};
  }

 private:
  Eigen::MatrixXd normal_;  // of [X r]
  double log_determinant_ = 0.0;
  Eigen::Index count_ = 0;
};

// X^T V X of a process of unit variance without its white part.
Eigen::MatrixXd CorrelatedSquares(std::span<const NoiseRun> runs, double length) {
  const Eigen::Index p = runs.front().design.cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(p, p);
  for (const NoiseRun& run : runs) {
    Eigen::VectorXd before = Eigen::VectorXd::Zero(p);
    for (size_t i = 0; i < run.places.size(); ++i) {
      const Eigen::VectorXd x = run.design.row(static_cast<Eigen::Index>(i)).transpose();
      if (i > 0) before *= std::exp(-(run.places[i] - run.places[i - 1]) / length);
      sum.noalias() += x * before.transpose() + before * x.transpose() + x * x.transpose();
      before += x;
    }
  }
  return sum;
}

Eigen::MatrixXd Squares(std::span<const NoiseRun> runs) {
  const Eigen::Index p = runs.front().design.cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(p, p);
  for (const NoiseRun& run : runs) sum.noalias() += run.design.transpose() * run.design;
  return sum;
}

std::vector<double> LengthsToTry(std::span<const NoiseRun> runs) {
  std::vector<double> steps;
  double longest = 0.0;
  for (const NoiseRun& run : runs) {
    for (size_t i = 1; i < run.places.size(); ++i)
      steps.push_back(run.places[i] - run.places[i - 1]);
    if (!run.places.empty()) longest = std::max(longest, run.places.back() - run.places.front());
  }
  std::vector<double> lengths;
  const double step = std::max(Quantile(std::move(steps), 0.5), 1e-3 * longest);
  for (double length = 2.0 * step; length > 0.0 && length <= kLongest * longest;
       length *= kLengthStep)
    lengths.push_back(length);
  return lengths;
}

Evidence EvidenceOf(std::span<const NoiseRun> runs,
                    const Eigen::VectorXd& information,
                    const Hypothesis& hypothesis) {
  Whitening whitening(information.size());
  for (const NoiseRun& run : runs) whitening.Add(run, hypothesis);
  return whitening.Finish(information);
}

// Hypotheses, their likelihood and what they make of the variances of the unknowns.
class Posterior {
 public:
  void Add(const Hypothesis& hypothesis, double log_weight, Eigen::VectorXd variances) {
    if (entries_.empty() || log_weight > entries_[likeliest_].log_weight)
      likeliest_ = entries_.size();
    entries_.push_back({hypothesis, log_weight, std::move(variances)});
  }

  // `claimed`: the variances of the unknowns if noise were white; `weights`: the unknowns' parts in
  // what the model predicts.
  [[nodiscard]] CorrelatedNoise Finish(const Eigen::VectorXd& claimed,
                                       const Eigen::VectorXd& weights) const {
    const Entry& best = entries_[likeliest_];
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(claimed.size());
    double total = 0.0;
    for (const Entry& entry : entries_) {
      const double weight = std::exp(entry.log_weight - best.log_weight);
      mean += weight * entry.variances.cwiseMax(kLeastVariance).array().log().matrix();
      total += weight;
    }
    CorrelatedNoise noise{.share = best.hypothesis.share, .length = best.hypothesis.length};
    noise.inflations = (mean / total).array().exp().matrix().cwiseQuotient(claimed).cwiseMax(1.0);
    const Eigen::VectorXd parts = claimed.cwiseProduct(weights);
    noise.inflation = noise.inflations.dot(parts) / parts.sum();
    return noise;
  }

 private:
  struct Entry {
    Hypothesis hypothesis{};
    double log_weight = 0.0;
    Eigen::VectorXd variances{};
  };
  std::vector<Entry> entries_;
  size_t likeliest_ = 0;
};

}  // namespace

CorrelatedNoise EstimateCorrelatedNoise(std::span<const NoiseRun> runs,
                                        const Eigen::VectorXd& information) {
  const Eigen::Index p = information.size();
  CorrelatedNoise nothing{.inflations = Eigen::VectorXd::Ones(p)};
  Eigen::Index count = 0;
  for (const NoiseRun& run : runs) count += run.residuals.size();
  const std::vector<double> lengths = LengthsToTry(runs);
  const Evidence white = count < p + 3 ? Evidence{} : EvidenceOf(runs, information, {});
  if (white.variance <= kLeastVariance || lengths.empty()) return nothing;

  const Eigen::MatrixXd squares = Squares(runs);
  Eigen::MatrixXd A = squares;
  A.diagonal() += information;
  const Eigen::MatrixXd inverse = A.ldlt().solve(Eigen::MatrixXd::Identity(p, p));
  const auto variances = [&](const Eigen::MatrixXd& X_V_X) {
    return Eigen::VectorXd((inverse * X_V_X * inverse).diagonal());
  };
  const Eigen::VectorXd independent = variances(squares);
  Posterior posterior;
  // As likely at first as all others together.
  const double others = static_cast<double>(lengths.size() * kShares.size());
  posterior.Add({}, white.log_likelihood + std::log(others), white.variance * independent);
  for (const double length : lengths) {
    const Eigen::VectorXd correlated = variances(CorrelatedSquares(runs, length));
    for (const double share : kShares) {
      const Evidence evidence = EvidenceOf(runs, information, {share, length});
      if (!(evidence.variance > 0.0)) continue;
      posterior.Add({share, length},
                    evidence.log_likelihood,
                    evidence.variance * ((1.0 - share) * independent + share * correlated));
    }
  }
  return posterior.Finish(white.variance * independent.cwiseMax(kLeastVariance),
                          squares.diagonal());
}

}  // namespace orbweave
