// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace orbweave {

/// Two different nodes between which something was measured.
struct GraphEdge {
  uint32_t a = 0;
  uint32_t b = 0;
};

/// Weighted least squares of differences over a graph: node values x, one row each, that minimise
///
///   sum over edges e of  w_e |x_b - x_a - d_e|^2      i.e.  L x = A^T W d,  L = A^T W A
///
/// with the weighted Laplacian L of the graph. Columns do not depend on each other. Only
/// differences are measured: the smallest node of every connected part is held at zero. Sparse
/// Cholesky whose pattern is analysed once, for any number of solutions with other weights.
class DifferenceSolver {
 public:
  DifferenceSolver(uint32_t num_nodes, const std::vector<GraphEdge>& edges);

  [[nodiscard]] uint32_t NumNodes() const { return static_cast<uint32_t>(column_.size()); }
  [[nodiscard]] const std::vector<GraphEdge>& Edges() const { return edges_; }
  /// Whether the node is the one of its part that is held.
  [[nodiscard]] bool IsHeld(uint32_t node) const { return column_[node] < 0; }

  /// `weights`: per edge, > 0. `differences`: a row per edge. Returns a row per node; nullopt when
  /// the weights span so many orders of magnitude that the system has no factor.
  [[nodiscard]] std::optional<Eigen::MatrixXd> Solve(const Eigen::VectorXd& weights,
                                                     const Eigen::MatrixXd& differences);

 private:
  /// Where an edge's weight goes among the values of the lower triangle; -1: nowhere.
  struct Slots {
    Eigen::Index aa = -1;
    Eigen::Index bb = -1;
    Eigen::Index ab = -1;
  };

  void HoldOneNodePerPart();
  void LayOutMatrix();

  std::vector<GraphEdge> edges_;
  std::vector<int> column_;  ///< per node; -1: held
  int num_unknowns_ = 0;
  std::vector<Slots> slots_{};  ///< per edge
  Eigen::SparseMatrix<double> laplacian_{};
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt_{};
};

}  // namespace orbweave
