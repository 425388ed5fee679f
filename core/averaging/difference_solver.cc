// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/difference_solver.h"

#include <algorithm>

#include "core/graph/disjoint_sets.h"

namespace orbweave {

DifferenceSolver::DifferenceSolver(uint32_t num_nodes, const std::vector<GraphEdge>& edges)
    : edges_(edges), column_(num_nodes, 0) {
  HoldOneNodePerPart();
  LayOutMatrix();
}

void DifferenceSolver::HoldOneNodePerPart() {
  DisjointSets sets(NumNodes());
  for (const GraphEdge& edge : edges_) sets.Unite(edge.a, edge.b);
  std::vector<uint8_t> has_held(NumNodes(), 0);
  for (uint32_t node = 0; node < NumNodes(); ++node) {
    uint8_t& part_has_held = has_held[sets.Find(node)];
    column_[node] = part_has_held == 0 ? -1 : num_unknowns_++;
    part_has_held = 1;
  }
}

void DifferenceSolver::LayOutMatrix() {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < num_unknowns_; ++i) entries.emplace_back(i, i, 0.0);
  for (const GraphEdge& edge : edges_) {
    const int a = column_[edge.a];
    const int b = column_[edge.b];
    if (a >= 0 && b >= 0) entries.emplace_back(std::max(a, b), std::min(a, b), 0.0);
  }
  laplacian_.resize(num_unknowns_, num_unknowns_);
  laplacian_.setFromTriplets(entries.begin(), entries.end());
  ldlt_.analyzePattern(laplacian_);

  const auto slot = [&](int row, int column) {
    return &laplacian_.coeffRef(row, column) - laplacian_.valuePtr();
  };
  slots_.reserve(edges_.size());
  for (const GraphEdge& edge : edges_) {
    const int a = column_[edge.a];
    const int b = column_[edge.b];
    Slots& slots = slots_.emplace_back();
    if (a >= 0) slots.aa = slot(a, a);
    if (b >= 0) slots.bb = slot(b, b);
    if (a >= 0 && b >= 0) slots.ab = slot(std::max(a, b), std::min(a, b));
  }
}

std::optional<Eigen::MatrixXd> DifferenceSolver::Solve(const Eigen::VectorXd& weights,
                                                       const Eigen::MatrixXd& differences) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(NumNodes(), differences.cols());
  if (num_unknowns_ == 0) return values;
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(num_unknowns_, differences.cols());
  laplacian_.coeffs().setZero();
  for (size_t e = 0; e < edges_.size(); ++e) {
    const auto row = static_cast<Eigen::Index>(e);
    const double w = weights[row];
    const Slots& slots = slots_[e];
    if (slots.aa >= 0) {
      laplacian_.valuePtr()[slots.aa] += w;
      rhs.row(column_[edges_[e].a]) -= w * differences.row(row);
    }
    if (slots.bb >= 0) {
      laplacian_.valuePtr()[slots.bb] += w;
      rhs.row(column_[edges_[e].b]) += w * differences.row(row);
    }
    if (slots.ab >= 0) laplacian_.valuePtr()[slots.ab] -= w;
  }
  ldlt_.factorize(laplacian_);
  if (ldlt_.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd solution = ldlt_.solve(rhs);
  if (!solution.allFinite()) return std::nullopt;
  for (uint32_t node = 0; node < NumNodes(); ++node) {
    if (column_[node] >= 0) values.row(node) = solution.row(column_[node]);
  }
  return values;
}

}  // namespace orbweave
