// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/linearise_similarity_edge.h"

#include <gtest/gtest.h>

#include "tests/core/averaging/similarity_samples.h"
#include "tests/support/numeric_jacobian.h"

namespace orbweave {
namespace {

TEST(LineariseSimilarityEdge, AgreesWithNumericDerivatives) {
  Random random(1);
  for (int i = 0; i < 10; ++i) {
    const SimilarityNode a{testing::RandomSimilarity(random), random.Uniform(0.5, 5.0)};
    const SimilarityNode b{testing::RandomSimilarity(random), random.Uniform(0.5, 5.0)};
    SimilarityChart measured{.anchor_in_b = testing::RandomPoint(random, 0.0, 5.0),
                             .length_in_a = 3.0};
    measured.a_from_b = a.world_from_node.Inverse() * b.world_from_node;
    measured.a_from_b = measured.At(testing::RandomVector7(random, 0.05));

    const LinearisedSimilarityEdge edge = LineariseSimilarityEdge(measured, a, b);
    const Eigen::MatrixXd J_a = NumericJacobian(
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
          return measured.Of(MoveNode(a, x).Inverse() * b.world_from_node);
        },
        Eigen::VectorXd::Zero(7));
    const Eigen::MatrixXd J_b = NumericJacobian(
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
          return measured.Of(a.world_from_node.Inverse() * MoveNode(b, x));
        },
        Eigen::VectorXd::Zero(7));
    EXPECT_LT((edge.J_a - J_a).norm(), 1e-4 * J_a.norm());
    EXPECT_LT((edge.J_b - J_b).norm(), 1e-4 * J_b.norm());
  }
}

TEST(LineariseSimilarityEdge, HasNoResidualWhereFramesAgree) {
  Random random(2);
  const SimilarityNode a{testing::RandomSimilarity(random), 1.0};
  const SimilarityNode b{testing::RandomSimilarity(random), 1.0};
  const SimilarityChart measured{.a_from_b = a.world_from_node.Inverse() * b.world_from_node};
  EXPECT_LT(LineariseSimilarityEdge(measured, a, b).r.norm(), 1e-9);
}

}  // namespace
}  // namespace orbweave
