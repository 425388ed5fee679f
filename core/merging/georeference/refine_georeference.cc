// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/refine_georeference.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr int kSteps = 30;
constexpr double kConverged = 1e-12;  // of shift over extent, angles and log scale
// Median squared length of two normal variables.
constexpr double kMedianChi2 = 1.386;
// Of what is known best: holds what nothing tells.
constexpr double kDamping = 1e-12;

// Unknowns: shift over extent, turn about the axes, log scale, about the middle.
using Step = Eigen::Matrix<double, 7, 1>;
using Rows = Eigen::Matrix<double, 3, 7>;

struct NormalEquations {
  Eigen::Matrix<double, 7, 7> A = Eigen::Matrix<double, 7, 7>::Zero();
  Step b = Step::Zero();

  void Add(const Rows& J, const Eigen::Vector3d& residual, const Eigen::Vector3d& weights) {
    const Eigen::Matrix<double, 7, 3> weighted = J.transpose() * weights.asDiagonal();
    A.noalias() += weighted * J;
    b.noalias() -= weighted * residual;
  }
};

// Where the model stands now.
struct Placed {
  std::vector<Eigen::Vector3d> in_enu{};
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double extent_m = 0.0;  // rms distance from the middle
};

Placed Place(const PositionPairs& pairs, const Sim3& enu_from_world) {
  Placed placed;
  const auto n = static_cast<double>(pairs.in_world.size());
  for (const Eigen::Vector3d& point : pairs.in_world) {
    placed.in_enu.push_back(enu_from_world * point);
    placed.middle += placed.in_enu.back() / n;
  }
  for (const Eigen::Vector3d& point : placed.in_enu)
    placed.extent_m += (point - placed.middle).squaredNorm() / n;
  placed.extent_m = std::sqrt(placed.extent_m);
  return placed;
}

// 1 / sigma per axis; 0 of unknown heights.
Eigen::Vector3d Exactness(const Eigen::Vector3d& sigma_m) {
  Eigen::Vector3d exactness = sigma_m.cwiseInverse();
  if (!IsHeightKnown(sigma_m.z())) exactness.z() = 0.0;
  return exactness;
}

void AddPositions(const PositionPairs& pairs, const Placed& placed, NormalEquations& equations) {
  std::vector<Eigen::Vector3d> whitened;
  std::vector<double> horizontal;
  for (size_t i = 0; i < pairs.in_enu.size(); ++i) {
    whitened.emplace_back(
        Exactness(pairs.sigma_m[i]).cwiseProduct(placed.in_enu[i] - pairs.in_enu[i]));
    horizontal.push_back(whitened.back().head<2>().squaredNorm());
  }
  const double scatter = std::max(1.0, Quantile(std::move(horizontal), 0.5) / kMedianChi2);
  for (size_t i = 0; i < whitened.size(); ++i) {
    const Eigen::Vector3d from_middle = placed.in_enu[i] - placed.middle;
    Rows J;
    J << placed.extent_m * Eigen::Matrix3d::Identity(), -SkewSymmetric(from_middle), from_middle;
    equations.Add(J,
                  placed.in_enu[i] - pairs.in_enu[i],
                  Exactness(pairs.sigma_m[i]).cwiseAbs2() / (scatter + whitened[i].squaredNorm()));
  }
}

void AddGravity(const Gravity& gravity,
                double inflation,
                const Sim3& enu_from_world,
                NormalEquations& equations) {
  const Eigen::Vector3d down = enu_from_world.rotation * gravity.down_in_world;
  const double sigma_rad = gravity.SigmaAt(AngleBetween(down, -Eigen::Vector3d::UnitZ()));
  Rows J = Rows::Zero();
  J.middleCols<3>(3) = -SkewSymmetric(down);
  equations.Add(J,
                down + Eigen::Vector3d::UnitZ(),
                Eigen::Vector3d::Constant(inflation / (sigma_rad * sigma_rad)));
}

Sim3 Moved(const Sim3& enu_from_world, const Placed& placed, const Step& step) {
  Sim3 move{std::exp(step[6]),
            RotationFromVector(Eigen::Vector3d(step.segment<3>(3))),
            Eigen::Vector3d::Zero()};
  move.translation = placed.middle + placed.extent_m * step.head<3>() - move * placed.middle;
  return move * enu_from_world;
}

}  // namespace

Sim3 RefineGeoreference(const PositionPairs& pairs,
                        const std::optional<Gravity>& gravity,
                        double inflation,
                        const Sim3& start) {
  Sim3 enu_from_world = start;
  for (int iteration = 0; iteration < kSteps; ++iteration) {
    const Placed placed = Place(pairs, enu_from_world);
    if (!(placed.extent_m > 0.0)) break;
    NormalEquations equations;
    AddPositions(pairs, placed, equations);
    if (gravity) AddGravity(*gravity, inflation, enu_from_world, equations);
    equations.A.diagonal().array() += kDamping * equations.A.diagonal().maxCoeff();
    const Step step = equations.A.ldlt().solve(equations.b);
    const Sim3 moved = Moved(enu_from_world, placed, step);
    if (!step.allFinite() || !(moved.scale > 0.0) || !moved.translation.allFinite()) break;
    enu_from_world = moved;
    if (step.norm() < kConverged) break;
  }
  return enu_from_world;
}

}  // namespace orbweave
