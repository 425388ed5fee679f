// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/linearise_similarity_edge.h"

namespace orbweave {

Sim3 MoveNode(const SimilarityNode& node, const Vector7d& x) {
  const Sim3& W = node.world_from_node;
  return {W.scale * std::exp(x[3]),
          (W.rotation * RotationFromVector(x.head<3>())).normalized(),
          W.translation + W.scale * (W.rotation * (node.length_in_node * x.tail<3>()))};
}

LinearisedSimilarityEdge LineariseSimilarityEdge(const SimilarityChart& measured,
                                                 const SimilarityNode& a,
                                                 const SimilarityNode& b) {
  const Sim3 E = a.world_from_node.Inverse() * b.world_from_node;
  const Eigen::Matrix3d sR = E.scale * E.rotation.toRotationMatrix();
  const Eigen::Vector3d& anchor_in_b = measured.anchor_in_b;
  const Eigen::Vector3d anchor_in_a = E * anchor_in_b;

  LinearisedSimilarityEdge edge;
  edge.r = measured.Of(E);

  // r_w = Log(Exp(-w_a) R_E Exp(w_b) R^T); the inverse left Jacobian of SO(3) to second order.
  const Eigen::Matrix3d r_cross = SkewSymmetric(edge.r.head<3>());
  const Eigen::Matrix3d left =
      Eigen::Matrix3d::Identity() - 0.5 * r_cross + r_cross * r_cross / 12.0;
  edge.J_a.block<3, 3>(0, 0) = -left;
  edge.J_b.block<3, 3>(0, 0) = left * E.rotation.toRotationMatrix();

  edge.J_a(3, 3) = -1.0;
  edge.J_b(3, 3) = 1.0;

  // The anchor seen from a.
  const double per_length = 1.0 / measured.length_in_a;
  edge.J_a.block<3, 3>(4, 0) = per_length * SkewSymmetric(anchor_in_a);
  edge.J_a.block<3, 1>(4, 3) = -per_length * anchor_in_a;
  edge.J_a.block<3, 3>(4, 4) = -per_length * a.length_in_node * Eigen::Matrix3d::Identity();
  edge.J_b.block<3, 3>(4, 0) = -per_length * sR * SkewSymmetric(anchor_in_b);
  edge.J_b.block<3, 1>(4, 3) = per_length * (sR * anchor_in_b);
  edge.J_b.block<3, 3>(4, 4) = per_length * b.length_in_node * sR;
  return edge;
}

}  // namespace orbweave
