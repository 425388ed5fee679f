// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/place_in_enu.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/quantile.h"
#include "core/mapping/position_agreement.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kStepShare = 0.1;
constexpr double kMostOfMedian = 10.0;
constexpr int kReweightings = 10;
constexpr double kMinAgreeing = 0.7;

/// The rotation R that makes trace(R^T M) largest.
Eigen::Quaterniond NearestRotation(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d signs = Vector3d::Ones();
  signs.z() = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
  return Eigen::Quaterniond(
      Eigen::Matrix3d(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose()));
}

Eigen::Quaterniond EnuFromWorld(const ClusterProblem& problem,
                                const DifferenceGraph& displacements) {
  Eigen::Quaterniond enu_from_world = Eigen::Quaterniond::Identity();
  const CauchyLoss loss(1.0);
  for (int round = 0; round <= kReweightings; ++round) {
    Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
    for (size_t e = 0; e < displacements.edges.size(); ++e) {
      const PosePrior& a = problem.images[displacements.edges[e].a].prior;
      const PosePrior& b = problem.images[displacements.edges[e].b].prior;
      if (!a.position_in_enu || !b.position_in_enu) continue;
      const double sigma_m = std::hypot(a.horizontal_sigma_m, b.horizontal_sigma_m);
      const Vector3d seen = displacements.differences.row(static_cast<Eigen::Index>(e));
      const Vector3d step = *b.position_in_enu - *a.position_in_enu;
      const double error = (step - enu_from_world * seen).norm() / sigma_m;
      const double weight = round == 0 ? 1.0 : loss.Weight(error * error);
      across += weight / (sigma_m * sigma_m) * step * seen.transpose();
    }
    enu_from_world = NearestRotation(across);
  }
  return enu_from_world;
}

/// Turned, and with weights that compare with those of positions.
void TurnToEnu(const Eigen::Quaterniond& enu_from_world, DifferenceGraph& displacements) {
  displacements.differences *= enu_from_world.conjugate().toRotationMatrix();
  const Eigen::VectorXd squares = displacements.differences.rowwise().squaredNorm();
  Eigen::VectorXd exactness = displacements.weights.cwiseProduct(squares);
  exactness /= UpperMedian({exactness.data(), exactness.data() + exactness.size()});
  displacements.weights = exactness.cwiseMax(1.0 / kMostOfMedian)
                              .cwiseMin(kMostOfMedian)
                              .cwiseQuotient(kStepShare * kStepShare * squares);
}

/// The displacements in some columns, and the positions there as displacements from one node more.
DifferenceGraph WithPositions(const ClusterProblem& problem,
                              std::span<const ImageSlot> images,
                              const DifferenceGraph& displacements,
                              Eigen::Index first,
                              Eigen::Index columns) {
  const uint32_t origin = displacements.num_nodes;
  DifferenceGraph graph{.num_nodes = origin + 1, .edges = displacements.edges};
  const auto most = displacements.differences.rows() + static_cast<Eigen::Index>(images.size());
  graph.differences.resize(most, columns);
  graph.weights.resize(most);
  Eigen::Index row = displacements.differences.rows();
  graph.differences.topRows(row) = displacements.differences.middleCols(first, columns);
  graph.weights.head(row) = displacements.weights;
  for (const ImageSlot image : images) {
    const PosePrior& prior = problem.images[image].prior;
    if (!prior.position_in_enu) continue;
    const double sigma_m = first == 0 ? prior.horizontal_sigma_m : prior.vertical_sigma_m;
    graph.edges.push_back({origin, image});
    graph.differences.row(row) = prior.position_in_enu->segment(first, columns).transpose();
    graph.weights[row++] = 1.0 / (sigma_m * sigma_m);
  }
  graph.differences.conservativeResize(row, columns);
  graph.weights.conservativeResize(row);
  return graph;
}

absl::StatusOr<Eigen::MatrixXd> Centres(const ClusterProblem& problem,
                                        std::span<const ImageSlot> images,
                                        const DifferenceGraph& displacements,
                                        const StageContext& context) {
  const auto origin = static_cast<Eigen::Index>(displacements.num_nodes);
  Eigen::MatrixXd centres(origin, 3);
  for (const auto& [first, columns] : {std::pair(0, 2), std::pair(2, 1)}) {
    ORBWEAVE_ASSIGN_OR_RETURN(
        const AveragedDifferences averaged,
        AverageDifferences(WithPositions(problem, images, displacements, first, columns), context));
    const Eigen::RowVectorXd zero = averaged.values.row(origin);
    centres.middleCols(first, columns) = averaged.values.topRows(origin).rowwise() - zero;
  }
  return centres;
}

}  // namespace

absl::StatusOr<std::optional<EnuPlacement>> PlaceInEnu(const ClusterProblem& problem,
                                                       std::span<const ImageSlot> images,
                                                       DifferenceGraph displacements,
                                                       const StageContext& context) {
  if (displacements.edges.empty() || !DoPositionsSpread(problem, images))
    return std::optional<EnuPlacement>();
  const Eigen::Quaterniond enu_from_world = EnuFromWorld(problem, displacements);
  TurnToEnu(enu_from_world, displacements);
  ORBWEAVE_ASSIGN_OR_RETURN(Eigen::MatrixXd centres,
                            Centres(problem, images, displacements, context));
  const auto centre_of = [&](ImageSlot image) -> Vector3d { return centres.row(image); };
  if (ShareOnPositions(problem, images, centre_of) < kMinAgreeing)
    return std::optional<EnuPlacement>();
  return EnuPlacement{enu_from_world, std::move(centres)};
}

}  // namespace orbweave
