// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"

namespace orbweave {

enum class BundleLoss { kLeastSquares, kCauchy, kHuber };

template <>
struct EnumNames<BundleLoss> {
  static constexpr std::array<std::pair<BundleLoss, std::string_view>, 3> kNames = {
      {{BundleLoss::kLeastSquares, "least_squares"},
       {BundleLoss::kCauchy, "cauchy"},
       {BundleLoss::kHuber, "huber"}}};
};

/// How far a predicted ray lies from its bearing: by the angle between them, or as the paper's (11)
/// in the pixels of the equirectangular image (EvaluateErpResidual).
enum class BundleResidual { kAngle, kErpPx };

template <>
struct EnumNames<BundleResidual> {
  static constexpr std::array<std::pair<BundleResidual, std::string_view>, 2> kNames = {
      {{BundleResidual::kAngle, "angle"}, {BundleResidual::kErpPx, "erp_px"}}};
};

enum class BundleSolver { kSchur, kCeres };

template <>
struct EnumNames<BundleSolver> {
  static constexpr std::array<std::pair<BundleSolver, std::string_view>, 2> kNames = {
      {{BundleSolver::kSchur, "schur"}, {BundleSolver::kCeres, "ceres"}}};
};

/// How to solve.
struct BundleOptions {
  BundleLoss loss = BundleLoss::kCauchy;
  double loss_scale = 2.0;
  int max_iterations = 50;
  double function_tolerance = 1e-6;
  double initial_lambda = 1e-6;
  BundleSolver solver = BundleSolver::kSchur;
  BundleResidual residual = BundleResidual::kAngle;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("loss", self.loss, "robust loss of the bearing residuals");
    visit("loss_scale",
          self.loss_scale,
          "residual, in sigmas, where the loss starts to bite",
          Range{0.1, 100});
    visit(
        "max_iterations", self.max_iterations, "Levenberg-Marquardt steps at most", Range{1, 1000});
    visit("function_tolerance",
          self.function_tolerance,
          "stop when the cost falls by less than this share",
          Range{1e-16, 0.1});
    visit("initial_lambda", self.initial_lambda, "start damping", Range{1e-16, 1e6});
    visit("solver", self.solver, "our own Schur solver, or Ceres for comparison");
    visit("residual",
          self.residual,
          "what is minimised: the angle of a ray to its bearing, or its distance in pixels of the "
          "equirectangular image, which weighs high and low latitudes more");
  }
};

}  // namespace orbweave
