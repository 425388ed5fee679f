// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/solve_similarity_graph.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "core/averaging/linearise_similarity_edge.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

constexpr int kMaxSteps = 100;
constexpr double kMinRelativeDecrease = 1e-10;
constexpr double kMaxDamping = 1e12;

using Triplets = std::vector<Eigen::Triplet<double>>;

// Lower triangle of the block of unknowns (row, column).
void AddBlock(int row, int column, const Matrix7d& block, Triplets& triplets) {
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 7; ++j) {
      if (row + i >= column + j) triplets.emplace_back(row + i, column + j, block(i, j));
    }
  }
}

}  // namespace

struct SimilaritySolver::NormalEquations {
  Eigen::SparseMatrix<double> H{};  // lower triangle
  Eigen::VectorXd g{};
};

SimilaritySolver::SimilaritySolver(const SimilarityGraph& graph,
                                   const std::vector<uint8_t>& is_fixed)
    : graph_(graph), column_(is_fixed.size(), -1) {
  for (size_t i = 0; i < is_fixed.size(); ++i) {
    if (is_fixed[i] != 0) continue;
    column_[i] = num_unknowns_;
    num_unknowns_ += 7;
  }
}

std::vector<double> SimilaritySolver::Errors(const std::vector<Sim3>& world_from_node) const {
  std::vector<double> errors;
  errors.reserve(graph_.edges.size());
  for (const SimilarityEdge& edge : graph_.edges) {
    const Sim3 a_from_b = world_from_node[edge.a].Inverse() * world_from_node[edge.b];
    const Vector7d r = edge.measured.Of(a_from_b);
    errors.push_back(std::sqrt(std::max(0.0, r.dot(edge.information * r))));
  }
  return errors;
}

double SimilaritySolver::Cost(const std::vector<Sim3>& world_from_node,
                              const std::vector<uint8_t>& is_used,
                              double loss_scale) const {
  const CauchyLoss loss(loss_scale);
  const std::vector<double> errors = Errors(world_from_node);
  double cost = 0.0;
  for (size_t e = 0; e < errors.size(); ++e) {
    if (is_used[e] == 0) continue;
    const double squared = errors[e] * errors[e];
    cost += graph_.edges[e].is_certain ? squared : loss.Cost(squared);
  }
  return cost;
}

SimilaritySolver::NormalEquations SimilaritySolver::Linearise(
    const std::vector<Sim3>& world_from_node,
    const std::vector<uint8_t>& is_used,
    double loss_scale) const {
  const CauchyLoss loss(loss_scale);
  NormalEquations normal{.H = Eigen::SparseMatrix<double>(num_unknowns_, num_unknowns_),
                         .g = Eigen::VectorXd::Zero(num_unknowns_)};
  Triplets triplets;
  for (size_t e = 0; e < graph_.edges.size(); ++e) {
    if (is_used[e] == 0) continue;
    const SimilarityEdge& edge = graph_.edges[e];
    const auto [r, J_a, J_b] =
        LineariseSimilarityEdge(edge.measured,
                                {world_from_node[edge.a], graph_.node_length[edge.a]},
                                {world_from_node[edge.b], graph_.node_length[edge.b]});
    const double weight = edge.is_certain ? 1.0 : loss.Weight(r.dot(edge.information * r));
    const Matrix7d W = weight * edge.information;
    const int a = column_[edge.a];
    const int b = column_[edge.b];
    if (a >= 0) {
      AddBlock(a, a, J_a.transpose() * W * J_a, triplets);
      normal.g.segment<7>(a) += J_a.transpose() * W * r;
    }
    if (b >= 0) {
      AddBlock(b, b, J_b.transpose() * W * J_b, triplets);
      normal.g.segment<7>(b) += J_b.transpose() * W * r;
    }
    if (a >= 0 && b >= 0) {
      const Matrix7d H_ab = J_a.transpose() * W * J_b;
      if (a > b) AddBlock(a, b, H_ab, triplets);
      if (b > a) AddBlock(b, a, H_ab.transpose(), triplets);
    }
  }
  normal.H.setFromTriplets(triplets.begin(), triplets.end());
  return normal;
}

std::vector<Sim3> SimilaritySolver::Moved(const std::vector<Sim3>& world_from_node,
                                          const Eigen::VectorXd& step) const {
  std::vector<Sim3> moved = world_from_node;
  for (size_t i = 0; i < moved.size(); ++i) {
    if (column_[i] < 0) continue;
    moved[i] = MoveNode({world_from_node[i], graph_.node_length[i]}, step.segment<7>(column_[i]));
  }
  return moved;
}

absl::StatusOr<SimilaritySolution> SimilaritySolver::Solve(const std::vector<Sim3>& start,
                                                           const std::vector<uint8_t>& is_used,
                                                           double loss_scale,
                                                           const StageContext& context) const {
  SimilaritySolution best{.world_from_node = start, .cost = Cost(start, is_used, loss_scale)};
  if (num_unknowns_ == 0) return best;
  double damping = 1e-6;
  NormalEquations normal = Linearise(best.world_from_node, is_used, loss_scale);
  for (int step = 0; step < kMaxSteps && damping < kMaxDamping; ++step) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    Eigen::SparseMatrix<double> damped = normal.H;
    damped.diagonal() *= 1.0 + damping;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt(damped);
    const Eigen::VectorXd delta = -ldlt.solve(normal.g);
    if (ldlt.info() != Eigen::Success || !delta.allFinite()) {
      damping = std::max(10.0 * damping, 1e-3);
      continue;
    }
    if (-normal.g.dot(delta) <= kMinRelativeDecrease * best.cost) break;
    std::vector<Sim3> candidate = Moved(best.world_from_node, delta);
    const double cost = Cost(candidate, is_used, loss_scale);
    if (!(cost < best.cost)) {
      damping = std::max(10.0 * damping, 1e-3);
      continue;
    }
    best = {.world_from_node = std::move(candidate), .cost = cost};
    damping *= 0.1;
    normal = Linearise(best.world_from_node, is_used, loss_scale);
  }
  return best;
}

}  // namespace orbweave
