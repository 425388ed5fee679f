// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/average_rotations.h"

#include <numbers>

#include "core/averaging/average_by_reweighting.h"
#include "core/averaging/spanning_forest.h"
#include "core/geometry/rotation.h"
#include "core/graph/adjacency.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

/// A triangle that fails to close by this angle counts half.
constexpr double kTriangleScaleRad = 2.0 * std::numbers::pi / 180.0;
/// What an edge in no triangle counts, in triangles.
constexpr double kWithoutTriangle = 1e-3;

std::vector<GraphEdge> EndsOf(const ViewGraph& graph) {
  std::vector<GraphEdge> ends;
  ends.reserve(graph.edges.size());
  for (const ViewEdge& edge : graph.edges) ends.push_back({edge.pair.a.value, edge.pair.b.value});
  return ends;
}

Eigen::VectorXd WeightsOf(const ViewGraph& graph) {
  Eigen::VectorXd weights(static_cast<Eigen::Index>(graph.edges.size()));
  Eigen::Index row = 0;
  for (const ViewEdge& edge : graph.edges) weights[row++] = edge.num_inliers;
  return weights;
}

/// Per edge: how many of its triangles close in rotation, each counted by how well.
Eigen::VectorXd TriangleVotes(const ViewGraph& graph) {
  const CauchyLoss loss(kTriangleScaleRad);
  const Adjacency adjacency(graph.num_images, graph.edges);
  Eigen::VectorXd votes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(graph.edges.size()));
  for (uint32_t ab = 0; ab < graph.edges.size(); ++ab) {
    const ImagePair& pair = graph.edges[ab].pair;
    ForEachCommonLink(adjacency.Of(pair.a.value),
                      adjacency.Of(pair.b.value),
                      [&](uint32_t c, uint32_t ac, uint32_t bc) {
                        if (c <= pair.b.value) return;  // each triangle once, a < b < c
                        const Eigen::Quaterniond c_from_a = graph.edges[ac].b_from_a.rotation;
                        const Eigen::Quaterniond c_from_b = graph.edges[bc].b_from_a.rotation;
                        const double angle = RotationAngle(c_from_a.conjugate() * c_from_b *
                                                           graph.edges[ab].b_from_a.rotation);
                        for (const uint32_t e : {ab, ac, bc})
                          votes[e] += loss.Weight(angle * angle);
                      });
  }
  return votes;
}

/// Measurements of the forest, chained outward from the images that are held.
std::vector<Eigen::Quaterniond> ChainForest(const DifferenceSolver& solver,
                                            const ViewGraph& graph,
                                            const Eigen::VectorXd& strength) {
  std::vector<uint8_t> is_root;
  for (uint32_t image = 0; image < graph.num_images; ++image) {
    is_root.push_back(solver.IsHeld(image) ? 1 : 0);
  }
  std::vector<Eigen::Quaterniond> R(graph.num_images, Eigen::Quaterniond::Identity());
  for (const ForestStep& step : WalkSpanningForest(solver.Edges(), strength, is_root)) {
    const Eigen::Quaterniond& b_from_a = graph.edges[step.edge].b_from_a.rotation;
    const bool is_forward = step.from == solver.Edges()[step.edge].a;
    R[step.to] = (is_forward ? b_from_a : b_from_a.conjugate()) * R[step.from];
  }
  return R;
}

/// A row Log(R_b^T M R_a) per edge.
Eigen::MatrixXd ResidualsOf(const ViewGraph& graph, const std::vector<Eigen::Quaterniond>& R) {
  Eigen::MatrixXd residuals(static_cast<Eigen::Index>(graph.edges.size()), 3);
  Eigen::Index row = 0;
  for (const ViewEdge& edge : graph.edges) {
    residuals.row(row++) = VectorFromRotation(R[edge.pair.b.value].conjugate() *
                                              edge.b_from_a.rotation * R[edge.pair.a.value])
                               .transpose();
  }
  return residuals;
}

}  // namespace

absl::StatusOr<AveragedRotations> AverageRotations(const ViewGraph& graph,
                                                   const StageContext& context) {
  DifferenceSolver solver(graph.num_images, EndsOf(graph));
  const Eigen::VectorXd weights = WeightsOf(graph);
  const Eigen::VectorXd strength =
      weights.cwiseProduct((TriangleVotes(graph).array() + kWithoutTriangle).matrix());
  AveragedRotations result{.cam_from_world = ChainForest(solver, graph, strength)};
  std::vector<Eigen::Quaterniond>& R = result.cam_from_world;
  const auto residuals = [&] { return ResidualsOf(graph, R); };
  const auto move = [&](const Eigen::MatrixXd& w) {
    for (uint32_t i = 0; i < graph.num_images; ++i) {
      R[i] = (R[i] * RotationFromVector(w.row(i).transpose())).normalized();
    }
  };
  ORBWEAVE_RETURN_IF_ERROR(AverageByReweighting(solver, weights, {residuals, move}, context));
  const Eigen::VectorXd errors = residuals().rowwise().norm();
  result.error_rad.assign(errors.data(), errors.data() + errors.size());
  return result;
}

}  // namespace orbweave
