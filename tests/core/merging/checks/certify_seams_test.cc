// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/certify_seams.h"

#include <gtest/gtest.h>

#include "core/merging/divide_world.h"
#include "core/merging/finalise_adjustment.h"
#include "core/partitioned_ba/adjust_subproblems.h"
#include "core/synthetic/make_corridor.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

constexpr uint32_t kPerCluster = 30;
/// The corridor's bearings are twice as exact as they claim.
constexpr double kBearingFactor = 0.25;

std::map<ImageId, uint32_t> Owners(const Reconstruction& model) {
  std::map<ImageId, uint32_t> owners;
  for (const auto& [id, image] : model.images) owners[id] = id.value / kPerCluster;
  return owners;
}

/// Ten panoramas round the border of clusters 0 and 1.
std::vector<Seam> OneSeam() {
  Seam seam{.cluster_a = 0, .cluster_b = 1};
  for (uint32_t i = kPerCluster - 5; i < kPerCluster + 5; ++i) seam.shared.emplace_back(i);
  return {seam};
}

std::vector<Subproblem> AdjustedSubproblemsOf(double noise_px) {
  const Corridor corridor = MakeCorridor({.panoramas = 2 * kPerCluster, .noise_px = noise_px});
  const Reconstruction model = testing::TrueModel(corridor);
  auto adjusted = AdjustSubproblems(
      DivideWorld(model, 0, Owners(model), {.reason = "none"}, corridor.manifest, 2.0), {}, {}, {});
  EXPECT_TRUE(adjusted.ok());
  return std::move(adjusted->subproblems);
}

SeamCertificate Certify(const std::vector<Subproblem>& subproblems) {
  SeamCertifier certifier(OneSeam(), {0, 1});
  for (const Subproblem& subproblem : subproblems) certifier.Add(PlaceBySides(subproblem));
  const std::vector<SeamCertificate> certificates = certifier.Finish(kBearingFactor);
  EXPECT_EQ(certificates.size(), 1U);
  return certificates.empty() ? SeamCertificate{} : certificates.front();
}

/// Shifts what panoramas of cluster 1 alone see.
void Tear(const Eigen::Vector3d& shift, std::vector<Subproblem>& subproblems) {
  for (Subproblem& subproblem : subproblems) {
    for (Track& track : subproblem.scene.tracks) {
      if (track.Name().image.value >= kPerCluster) track.point_in_world += shift;
    }
  }
}

TEST(SeamCertifier, FindsNoMoreThanNoiseWhereBothSidesAgree) {
  const SeamCertificate seam = Certify(AdjustedSubproblemsOf(0.5));
  EXPECT_EQ(seam.num_images, 10U);
  EXPECT_LT(seam.position_jump_m, 3.0 * seam.position_noise_m);
  EXPECT_LT(seam.rotation_jump_deg, 3.0 * seam.rotation_noise_deg);
  EXPECT_GT(seam.position_jump_m, 0.2 * seam.position_noise_m);
}

TEST(SeamCertifier, FindsNothingInExactBearings) {
  const SeamCertificate seam = Certify(AdjustedSubproblemsOf(0.0));
  EXPECT_LT(seam.position_jump_m, 1e-6);
  EXPECT_LT(seam.rotation_jump_deg, 1e-6);
}

TEST(SeamCertifier, FindsASideThatIsTornOff) {
  std::vector<Subproblem> subproblems = AdjustedSubproblemsOf(0.5);
  const Eigen::Vector3d shift(0.03, -0.04, 0.0);
  Tear(shift, subproblems);
  const SeamCertificate seam = Certify(subproblems);
  EXPECT_GT(seam.position_jump_m, 0.3 * shift.norm());
  EXPECT_GT(seam.position_jump_m, 6.0 * seam.position_noise_m);
}

TEST(SeamCertifier, KnowsNothingOfASeamWithoutPoints) {
  std::vector<Subproblem> subproblems = AdjustedSubproblemsOf(0.5);
  for (Subproblem& subproblem : subproblems) subproblem.scene.tracks.clear();
  EXPECT_EQ(Certify(subproblems).num_images, 0U);
}

}  // namespace
}  // namespace orbweave
