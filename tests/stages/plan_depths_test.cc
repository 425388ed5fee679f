// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/plan_depths/plan_depths.h"

#include <gtest/gtest.h>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

struct Finished {
  ImageManifest manifest{};
  FinalisedModel model{.worlds = {{}}, .subproblems = {{}}};
  ChosenSources chosen{};
};

/// Images 0 to 3 in a row, 0 to 2 with sources; 4 is in no model, 5 placed loosely.
Finished Walk() {
  Finished walk;
  for (uint32_t i = 0; i < 6; ++i) {
    walk.manifest.images.push_back({.id = ImageId(i),
                                    .name = std::to_string(i) + ".jpg",
                                    .content = DigestOf(std::to_string(i)),
                                    .camera = {2048, 1024}});
    if (i == 4) continue;
    walk.model.worlds[0].images[ImageId(i)] = {
        .cam_from_world = Rigid3::FromCentre(RotationFromVector({0.1 * i, 0.3, -0.2 * i}),
                                             {2.5 * i, 0.1 * i * i, 0.0}),
        .loose = i == 5};
  }
  for (uint32_t i = 0; i < 3; ++i) {
    walk.chosen.choices.push_back(
        {.image = ImageId(i),
         .sources = {ImageId(i == 0 ? 1 : i - 1), ImageId(3), ImageId(5)},
         .seeds = {{.bearing = {0.0, 0.6, 0.8}, .range_m = 7.123456789, .sigma_m = 0.1}},
         .min_range_m = 1.0,
         .max_range_m = 30.0});
  }
  walk.chosen.choices.push_back({.image = ImageId(3), .problem = "it stands alone"});
  return walk;
}

TEST(PlanDepths, HasARecipeForEveryPanoramaWithSourcesAndAReasonForEachOther) {
  const Finished walk = Walk();
  DepthPlanner planner(walk.manifest, walk.model, 3072);
  const auto recipes = planner.Plan(walk.chosen);
  ASSERT_TRUE(recipes.ok()) << recipes.status();
  ASSERT_EQ(recipes->size(), 3U);
  EXPECT_EQ((*recipes)[1].reference.content, DigestOf("1"));
  ASSERT_EQ((*recipes)[1].sources.size(), 2U);  // 5 has no place of its own
  EXPECT_EQ((*recipes)[1].sources[0].panorama.image, ImageId(0));
  const DensePlan plan = std::move(planner).Finish();
  ASSERT_EQ(plan.panoramas.size(), 3U);
  EXPECT_EQ(plan.panoramas[2].file.image, ImageId(2));
  ASSERT_EQ(plan.omitted.size(), 3U);
  EXPECT_EQ(plan.omitted[0].reason, "it stands alone");
  EXPECT_EQ(plan.omitted[1].reason, "it is in no model");
  EXPECT_NE(plan.omitted[2].reason.find("GNSS"), std::string::npos);
}

TEST(PlanDepths, RoundsFarBelowTheNoise) {
  const Finished walk = Walk();
  DepthPlanner planner(walk.manifest, walk.model, 3072);
  const DepthRecipe recipe = planner.Plan(walk.chosen).value()[2];
  const auto& images = walk.model.worlds[0].images;
  const Rigid3 exact =
      images.at(ImageId(1)).cam_from_world * images.at(ImageId(2)).cam_from_world.Inverse();
  const Rigid3& rounded = recipe.sources[0].source_from_reference;
  const double unit_m = exact.translation.norm();
  EXPECT_LT(RotationAngle(exact.rotation * rounded.rotation.conjugate()), 2e-6);
  EXPECT_LT((exact.translation / unit_m - rounded.translation).norm(), 2e-5);
  EXPECT_NEAR(recipe.seeds[0].range_m * unit_m, 7.123456789, 1e-4);
}

TEST(PlanDepths, IsTheSameInAnotherFrameAndScale) {
  Finished walk = Walk();
  DepthPlanner planner(walk.manifest, walk.model, 3072);
  const auto recipes = planner.Plan(walk.chosen).value();
  const double scale = 1.7;
  walk.model.worlds[0].model_from_world = {
      scale, Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized(), {400.0, -70.0, 3.0}};
  for (SourceChoice& choice : walk.chosen.choices) {
    choice.min_range_m *= scale;
    choice.max_range_m *= scale;
    for (DepthSeed& seed : choice.seeds) {
      seed.range_m *= scale;
      seed.sigma_m *= scale;
    }
  }
  DepthPlanner moved(walk.manifest, walk.model, 3072);
  const auto same = moved.Plan(walk.chosen).value();
  for (size_t i = 0; i < recipes.size(); ++i) {
    EXPECT_EQ(recipes[i].min_range, same[i].min_range);
    EXPECT_EQ(recipes[i].seeds[0].range_m, same[i].seeds[0].range_m);
    for (size_t s = 0; s < recipes[i].sources.size(); ++s) {
      const Rigid3& a = recipes[i].sources[s].source_from_reference;
      const Rigid3& b = same[i].sources[s].source_from_reference;
      EXPECT_EQ(a.rotation.coeffs(), b.rotation.coeffs());
      EXPECT_EQ(a.translation, b.translation);
    }
  }
}

TEST(PlanDepths, BringsPicturesToAWidthThatHalvesEvenly) {
  Finished walk = Walk();
  walk.manifest.images[0].camera = {5640, 2820};
  walk.manifest.images[1].camera = {1000, 500};
  DepthPlanner planner(walk.manifest, walk.model, 5640);
  const auto recipes = planner.Plan(walk.chosen).value();
  EXPECT_EQ(recipes[0].width_px, 5648);
  EXPECT_EQ(recipes[1].width_px, 1008);
  EXPECT_EQ(recipes[2].width_px, 2048);
  DepthPlanner reducing(walk.manifest, walk.model, 1024);
  EXPECT_EQ(reducing.Plan(walk.chosen).value()[0].width_px, 1024);
}

TEST(PlanDepths, KeepsAModelWithAFrameOfItsOwnApart) {
  Finished walk = Walk();
  FinalisedWorld other;
  other.images[ImageId(4)] = {};
  walk.model.worlds.push_back(other);
  DepthPlanner planner(walk.manifest, walk.model, 3072);
  const DensePlan plan = std::move(planner).Finish();
  EXPECT_NE(plan.omitted[4].reason.find("sparse/1"), std::string::npos);
}

TEST(PlanDepths, RefusesAnImageThatTheManifestLacks) {
  Finished walk = Walk();
  walk.chosen.choices[0].image = ImageId(77);
  DepthPlanner planner(walk.manifest, walk.model, 3072);
  EXPECT_FALSE(planner.Plan(walk.chosen).ok());
}

}  // namespace
}  // namespace orbweave
