// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/fit_plan.h"

#include <cmath>

#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Complex = std::complex<double>;

constexpr int kReweightings = 20;

PlanFit FitPlan(const std::vector<PlanStation>& stations) {
  double weights = 0.0;
  Complex from{};
  Complex to{};
  for (const PlanStation& each : stations) {
    const double w = each.weight / (each.sigma_m * each.sigma_m);
    weights += w;
    from += w * each.centre;
    to += w * each.position;
  }
  from /= weights;
  to /= weights;
  Complex across{};
  double spread = 0.0;
  for (const PlanStation& each : stations) {
    const double w = each.weight / (each.sigma_m * each.sigma_m);
    across += w * std::conj(each.centre - from) * (each.position - to);
    spread += w * std::norm(each.centre - from);
  }
  if (!(spread > 0.0)) return {};
  PlanFit fit{.turn = across / spread};
  fit.shift = to - fit.turn * from;
  fit.extent_sigmas = std::abs(fit.turn) * std::sqrt(spread / static_cast<double>(stations.size()));
  return fit;
}

}  // namespace

PlanFit FitPlanRobustly(std::vector<PlanStation>& stations) {
  const CauchyLoss loss(1.0);
  PlanFit fit = FitPlan(stations);
  for (int round = 0; round < kReweightings; ++round) {
    for (PlanStation& each : stations) {
      const double error = fit.ErrorSigmas(each);
      each.weight = loss.Weight(error * error);
    }
    fit = FitPlan(stations);
  }
  return fit;
}

}  // namespace orbweave
