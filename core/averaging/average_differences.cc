// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/average_differences.h"

#include "core/averaging/average_by_reweighting.h"

namespace orbweave {

absl::StatusOr<AveragedDifferences> AverageDifferences(const DifferenceGraph& graph,
                                                       const StageContext& context) {
  AveragedDifferences result;
  result.values = Eigen::MatrixXd::Zero(graph.num_nodes, graph.differences.cols());
  const auto residuals = [&] {
    Eigen::MatrixXd lacking = graph.differences;
    for (size_t e = 0; e < graph.edges.size(); ++e) {
      const auto row = static_cast<Eigen::Index>(e);
      lacking.row(row) -= result.values.row(graph.edges[e].b) - result.values.row(graph.edges[e].a);
    }
    return lacking;
  };
  const auto move = [&](const Eigen::MatrixXd& moves) { result.values += moves; };

  DifferenceSolver solver(graph.num_nodes, graph.edges);
  ORBWEAVE_RETURN_IF_ERROR(AverageByReweighting(solver, graph.weights, {residuals, move}, context));
  result.error = residuals().rowwise().norm();
  return result;
}

}  // namespace orbweave
