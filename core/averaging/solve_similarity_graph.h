// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/averaging/similarity_graph.h"
#include "core/base/stage_context.h"

namespace orbweave {

struct SimilaritySolution {
  std::vector<Sim3> world_from_node{};
  double cost = 0.0;
};

/// Minimises the robust cost of a similarity graph from a start, with some nodes held fixed.
class SimilaritySolver {
 public:
  /// Keeps references. `is_fixed`: per node; every connected part has a fixed node.
  SimilaritySolver(const SimilarityGraph& graph, const std::vector<uint8_t>& is_fixed);

  /// Levenberg-Marquardt with a Cauchy loss of the given scale over the edges with is_used != 0.
  /// Returns the best state seen. Cancelled when asked to stop.
  [[nodiscard]] absl::StatusOr<SimilaritySolution> Solve(const std::vector<Sim3>& start,
                                                         const std::vector<uint8_t>& is_used,
                                                         double loss_scale,
                                                         const StageContext& context) const;

  /// Per edge sqrt(r^T information r), used or not.
  [[nodiscard]] std::vector<double> Errors(const std::vector<Sim3>& world_from_node) const;

 private:
  struct NormalEquations;
  [[nodiscard]] double Cost(const std::vector<Sim3>& world_from_node,
                            const std::vector<uint8_t>& is_used,
                            double loss_scale) const;
  [[nodiscard]] NormalEquations Linearise(const std::vector<Sim3>& world_from_node,
                                          const std::vector<uint8_t>& is_used,
                                          double loss_scale) const;
  [[nodiscard]] std::vector<Sim3> Moved(const std::vector<Sim3>& world_from_node,
                                        const Eigen::VectorXd& step) const;

  const SimilarityGraph& graph_;
  std::vector<int> column_;  // per node: first unknown, -1 for a fixed node
  int num_unknowns_ = 0;
};

}  // namespace orbweave
