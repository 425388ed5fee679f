// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/average_by_reweighting.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/quantile.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

constexpr int kMaxSteps = 30;  // of each phase
/// Residuals below this are exact; radians, logarithms or shares of a length.
constexpr double kExact = 1e-6;
/// A phase ends when no value moves by more than this share of the residuals' median.
constexpr double kAtRest = 1e-2;

double Median(const Eigen::VectorXd& values) {
  return UpperMedian({values.data(), values.data() + values.size()});
}

class Reweighting {
 public:
  Reweighting(DifferenceSolver& solver,
              const Eigen::VectorXd& weights,
              const DifferenceModel& model,
              const StageContext& context)
      : solver_(solver), weights_(weights / weights.mean()), model_(model), context_(context) {
    Look();
  }

  /// `factor`: squared weighted residual -> factor of the edge's weight.
  absl::Status Repeat(const std::function<double(double)>& factor) {
    for (int step = 0; step < kMaxSteps; ++step) {
      ORBWEAVE_RETURN_IF_ERROR(context_.CheckStop());
      const Eigen::VectorXd reweighted = weights_.cwiseProduct(squared_.unaryExpr(factor));
      const auto moves = solver_.Solve(reweighted, residuals_);
      if (!moves) break;
      model_.move(*moves);
      Look();
      if (moves->rowwise().norm().maxCoeff() <= kAtRest * Scale()) break;
    }
    return absl::OkStatus();
  }

  [[nodiscard]] double Scale() const { return std::max(kExact, std::sqrt(Median(squared_))); }

 private:
  void Look() {
    residuals_ = model_.residuals();
    squared_ = residuals_.rowwise().squaredNorm().cwiseProduct(weights_);
  }

  DifferenceSolver& solver_;
  Eigen::VectorXd weights_;
  const DifferenceModel& model_;
  const StageContext& context_;
  Eigen::MatrixXd residuals_{};
  Eigen::VectorXd squared_{};
};

}  // namespace

absl::Status AverageByReweighting(DifferenceSolver& solver,
                                  const Eigen::VectorXd& weights,
                                  const DifferenceModel& model,
                                  const StageContext& context) {
  if (solver.Edges().empty()) return absl::OkStatus();
  Reweighting reweighting(solver, weights, model, context);
  ORBWEAVE_RETURN_IF_ERROR(reweighting.Repeat(
      [](double squared) { return 1.0 / std::max(kExact, std::sqrt(squared)); }));
  const CauchyLoss loss(2.0 * reweighting.Scale());
  return reweighting.Repeat([&](double squared) { return loss.Weight(squared); });
}

}  // namespace orbweave
