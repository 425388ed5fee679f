// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/seam_evidence.h"

#include <gtest/gtest.h>

#include "tests/core/merging/alignment/seam_world.h"
#include "tests/support/numeric_jacobian.h"

namespace orbweave {
namespace {

using testing::MakeSeam;
using testing::SeamWorld;

SimilarityChart ChartNear(const Sim3& a_from_b, Random& random) {
  SimilarityChart chart{.a_from_b = a_from_b,
                        .anchor_in_b = testing::RandomPoint(random, 0.0, 5.0),
                        .length_in_a = 4.0};
  Vector7d x;
  for (int i = 0; i < 7; ++i) x[i] = 1e-3 * random.Normal();
  chart.a_from_b = chart.At(x);
  return chart;
}

// The cost at coordinates x of a chart.
template <typename Add>
auto CostAt(const SimilarityChart& chart, const Add& add) {
  return [&chart, &add](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    SimilarityChart moved = chart;
    moved.a_from_b = chart.At(x);
    Linearisation<7> sum;
    add(moved, sum);
    return Eigen::VectorXd::Constant(1, sum.cost);
  };
}

TEST(SeamEvidence, AgreesWithTheTrueSimilarity) {
  const SeamWorld seam = MakeSeam(16, 0.0, 1);
  ASSERT_GT(seam.evidence.tracks.size(), 50U);
  ASSERT_EQ(seam.evidence.cameras.size(), 4U);
  for (const SeamTrack& track : seam.evidence.tracks)
    EXPECT_LT(TrackError(track, seam.a_from_b), 4.0);
  for (const SeamCamera& camera : seam.evidence.cameras) {
    EXPECT_LT(CameraError(camera, seam.a_from_b), 1e-6);
  }
}

TEST(SeamEvidence, HasTheGradientOfItsTracks) {
  const SeamWorld seam = MakeSeam(16, 0.01, 2);
  Random random(3);
  const CauchyLoss loss(3.0);
  for (size_t t = 0; t < 10; ++t) {
    const SimilarityChart chart = ChartNear(seam.a_from_b, random);
    const auto add = [&](const SimilarityChart& at, Linearisation<7>& sum) {
      AddTrack(seam.evidence.tracks[t], at, loss, sum);
    };
    Linearisation<7> sum;
    add(chart, sum);
    const Eigen::MatrixXd numeric =
        NumericJacobian(CostAt(chart, add), Eigen::VectorXd::Zero(7), 1e-7);
    EXPECT_LT((2.0 * sum.g.transpose() - numeric).norm(), 1e-4 * numeric.norm());
  }
}

TEST(SeamEvidence, HasTheGradientOfItsCameras) {
  const SeamWorld seam = MakeSeam(16, 0.01, 4);
  Random random(5);
  const CauchyLoss loss(3.0);
  for (const SeamCamera& camera : seam.evidence.cameras) {
    const SimilarityChart chart = ChartNear(seam.a_from_b, random);
    const auto add = [&](const SimilarityChart& at, Linearisation<7>& sum) {
      AddCamera(camera, at, loss, sum);
    };
    Linearisation<7> sum;
    add(chart, sum);
    const Eigen::MatrixXd numeric =
        NumericJacobian(CostAt(chart, add), Eigen::VectorXd::Zero(7), 1e-7);
    EXPECT_LT((2.0 * sum.g.transpose() - numeric).norm(), 1e-3 * numeric.norm());
  }
}

TEST(SeamEvidence, ForgivesAWrongObserver) {
  const SeamWorld seam = MakeSeam(16, 0.0, 6);
  SeamTrack track = seam.evidence.tracks.front();
  const double before = TrackError(track, seam.a_from_b);
  track.sightings.front().bearing *= -1.0;
  EXPECT_LT(TrackError(track, seam.a_from_b), before + 4.0);
}

TEST(SeamEvidence, LeavesOutLooseObservers) {
  Random random(7);
  auto world = testing::Split(
      testing::MakeStreet(testing::StraightLine(16, 2.0), random), 2, 6, 10, 0.0, random);
  Reconstruction& a = world.submodels[0].reconstruction;
  Reconstruction& b = world.submodels[1].reconstruction;
  for (Reconstruction* side : {&a, &b}) {
    for (auto& [id, image] : side->images) image.loose = id != ImageId(7);
  }
  const auto index_a = IndexFeatures(a);
  const CommonView view = FindCommonView(a, index_a, b, IndexFeatures(b));
  EXPECT_EQ(view.images, (std::vector<ImageId>{ImageId(7)}));
  for (const SeamTrack& track : GatherSeamEvidence(a, index_a, b, view).tracks) {
    EXPECT_LE(track.sightings.size(), 2U);
  }
}

}  // namespace
}  // namespace orbweave
