// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/correlated_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
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
Eigen::MatrixXd CorrelatedSquares(const std::vector<NoiseRun>& runs, double length) {
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

Eigen::MatrixXd Squares(const std::vector<NoiseRun>& runs) {
  const Eigen::Index p = runs.front().design.cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(p, p);
  for (const NoiseRun& run : runs) sum.noalias() += run.design.transpose() * run.design;
  return sum;
}

Evidence EvidenceOf(const NoiseAxis& axis, const Hypothesis& hypothesis) {
  Whitening whitening(axis.information.size());
  for (const NoiseRun& run : axis.runs) whitening.Add(run, hypothesis);
  return whitening.Finish(axis.information);
}

// An axis that says something, and what hypotheses make of the variances of its unknowns.
class ToldAxis {
 public:
  ToldAxis(const NoiseAxis& axis, const Evidence& white)
      : axis_(&axis), white_(white), squares_(Squares(axis.runs)) {
    Eigen::MatrixXd A = squares_;
    A.diagonal() += axis.information;
    inverse_ = A.ldlt().solve(Eigen::MatrixXd::Identity(A.rows(), A.cols()));
    independent_ = VariancesOf(squares_);
  }

  [[nodiscard]] const NoiseAxis& Axis() const { return *axis_; }

  /// Of the unknowns, of a process of unit variance without its white part.
  [[nodiscard]] Eigen::VectorXd Correlated(double length) const {
    return VariancesOf(CorrelatedSquares(axis_->runs, length));
  }

  /// What a hypothesis makes of the unknowns; `correlated`: Correlated(its length).
  [[nodiscard]] Eigen::VectorXd Variances(const Hypothesis& hypothesis,
                                          double variance,
                                          const Eigen::VectorXd& correlated) const {
    return variance * ((1.0 - hypothesis.share) * independent_ + hypothesis.share * correlated);
  }

  /// `log_variances`: their mean over the hypotheses; `best`: the likeliest.
  [[nodiscard]] CorrelatedNoise Finish(const Eigen::VectorXd& log_variances,
                                       const Hypothesis& best) const {
    const Eigen::VectorXd claimed = white_.variance * independent_.cwiseMax(kLeastVariance);
    CorrelatedNoise noise{.share = best.share, .length = best.length};
    noise.inflations = log_variances.array().exp().matrix().cwiseQuotient(claimed).cwiseMax(1.0);
    const Eigen::VectorXd parts = claimed.cwiseProduct(squares_.diagonal());
    noise.inflation = noise.inflations.dot(parts) / parts.sum();
    return noise;
  }

 private:
  [[nodiscard]] Eigen::VectorXd VariancesOf(const Eigen::MatrixXd& X_V_X) const {
    return (inverse_ * X_V_X * inverse_).diagonal();
  }

  const NoiseAxis* axis_;
  Evidence white_;
  Eigen::MatrixXd squares_;
  Eigen::MatrixXd inverse_;
  Eigen::VectorXd independent_;
};

std::vector<double> LengthsToTry(const std::vector<ToldAxis>& axes) {
  std::vector<double> steps;
  double longest = 0.0;
  for (const ToldAxis& axis : axes) {
    for (const NoiseRun& run : axis.Axis().runs) {
      for (size_t i = 1; i < run.places.size(); ++i)
        steps.push_back(run.places[i] - run.places[i - 1]);
      if (!run.places.empty()) longest = std::max(longest, run.places.back() - run.places.front());
    }
  }
  std::vector<double> lengths;
  const double step = std::max(Quantile(std::move(steps), 0.5), 1e-3 * longest);
  for (double length = 2.0 * step; length > 0.0 && length <= kLongest * longest;
       length *= kLengthStep)
    lengths.push_back(length);
  return lengths;
}

// Hypotheses, their likelihood and what they make of the unknowns of each axis.
class Posterior {
 public:
  explicit Posterior(const std::vector<ToldAxis>& axes) : axes_(axes) {}

  /// `correlated`: per axis, ToldAxis::Correlated. Hypotheses that an axis cannot have are none.
  void Add(const Hypothesis& hypothesis,
           double log_prior,
           const std::vector<Eigen::VectorXd>& correlated) {
    Entry entry{.hypothesis = hypothesis, .log_prior = log_prior};
    for (size_t a = 0; a < axes_.size(); ++a) {
      const Evidence evidence = EvidenceOf(axes_[a].Axis(), hypothesis);
      if (!(evidence.variance > 0.0)) return;
      entry.log_likelihoods.push_back(evidence.log_likelihood);
      entry.variances.push_back(axes_[a].Variances(hypothesis, evidence.variance, correlated[a]));
    }
    entries_.push_back(std::move(entry));
  }

  /// Of an axis, where all axes say how errors hang together, or it alone: whichever claims less.
  [[nodiscard]] CorrelatedNoise Finish(size_t axis) const {
    CorrelatedNoise together = Mean(axis, [](const Entry& entry) {
      return std::accumulate(
          entry.log_likelihoods.begin(), entry.log_likelihoods.end(), entry.log_prior);
    });
    CorrelatedNoise alone = Mean(
        axis, [axis](const Entry& entry) { return entry.log_prior + entry.log_likelihoods[axis]; });
    return together.inflation < alone.inflation ? alone : together;
  }

 private:
  struct Entry {
    Hypothesis hypothesis{};
    double log_prior = 0.0;
    std::vector<double> log_likelihoods{};     ///< per axis
    std::vector<Eigen::VectorXd> variances{};  ///< per axis
  };

  template <typename LogWeight>
  [[nodiscard]] CorrelatedNoise Mean(size_t axis, LogWeight log_weight) const {
    const auto best = std::ranges::max_element(entries_, {}, log_weight);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(best->variances[axis].size());
    double total = 0.0;
    for (const Entry& entry : entries_) {
      const double weight = std::exp(log_weight(entry) - log_weight(*best));
      mean += weight * entry.variances[axis].cwiseMax(kLeastVariance).array().log().matrix();
      total += weight;
    }
    return axes_[axis].Finish(mean / total, best->hypothesis);
  }

  const std::vector<ToldAxis>& axes_;
  std::vector<Entry> entries_;
};

std::vector<Eigen::VectorXd> CorrelatedOf(const std::vector<ToldAxis>& axes, double length) {
  std::vector<Eigen::VectorXd> correlated;
  for (const ToldAxis& axis : axes) correlated.push_back(axis.Correlated(length));
  return correlated;
}

}  // namespace

Eigen::Index NoiseAxis::Count() const {
  Eigen::Index count = 0;
  for (const NoiseRun& run : runs) count += run.residuals.size();
  return count;
}

std::vector<CorrelatedNoise> EstimateCorrelatedNoise(const std::vector<NoiseAxis>& axes) {
  std::vector<CorrelatedNoise> noises;
  std::vector<ToldAxis> told;
  std::vector<size_t> axis_of_told;
  for (const NoiseAxis& axis : axes) {
    const Eigen::Index p = axis.information.size();
    noises.push_back({.inflations = Eigen::VectorXd::Ones(p)});
    if (axis.Count() < p + 3) continue;
    const Evidence white = EvidenceOf(axis, {});
    if (white.variance <= kLeastVariance) continue;
    told.emplace_back(axis, white);
    axis_of_told.push_back(noises.size() - 1);
  }
  if (told.empty()) return noises;
  const std::vector<double> lengths = LengthsToTry(told);
  if (lengths.empty()) return noises;
  Posterior posterior(told);
  // As likely at first as all others together.
  const auto others = static_cast<double>(lengths.size() * kShares.size());
  posterior.Add({}, std::log(others), CorrelatedOf(told, lengths.front()));
  for (const double length : lengths) {
    const std::vector<Eigen::VectorXd> correlated = CorrelatedOf(told, length);
    for (const double share : kShares) posterior.Add({share, length}, 0.0, correlated);
  }
  for (size_t a = 0; a < told.size(); ++a) noises[axis_of_told[a]] = posterior.Finish(a);
  return noises;
}

}  // namespace orbweave
