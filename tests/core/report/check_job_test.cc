// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "core/report/build_job_report.h"
#include "core/report/check_contradicted_pairs.h"
#include "core/report/judge_model.h"
#include "core/synthetic/street.h"

namespace orbweave {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A street of images 3 m apart, neighbours joined by verified pairs. images_of_model[m]: first and
/// last + 1 of those that model m holds; the models are free unless `on_earth`.
JobResults Street(uint32_t num_images,
                  const std::vector<std::pair<uint32_t, uint32_t>>& images_of_model,
                  bool on_earth = false) {
  JobResults results;
  for (uint32_t i = 0; i < num_images; ++i) {
    ImageRecord& image = results.manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = "pano_" + std::to_string(i) + ".jpg";
    if (i > 0) results.view_graph.edges.push_back({ImageId(i - 1), ImageId(i)});
    if (!on_earth) continue;
    image.prior.position_in_enu = Eigen::Vector3d(3.0 * i, 0.0, 0.0);
    image.prior.horizontal_sigma_m = 2.0;
  }
  for (const auto& [begin, end] : images_of_model) {
    AdjustedModel& model = results.models.emplace_back();
    for (uint32_t i = begin; i < end; ++i) {
      model.images[ImageId(i)] = {
          .cam_from_world = Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {3.0 * i, 0.0, 0.0}),
          .uncertainty = PoseUncertainty{}};
    }
    model.report.adjustments = {{.iterations = 9, .converged = true}};
    model.report.residual_px_rms = 0.6;
    model.report.uncertainty.known = true;
    model.report.gnss.reason = "no image has a GNSS position";
    if (!on_earth) continue;
    model.report.gnss = {.used = true, .num_priors = end - begin, .num_inliers = end - begin};
  }
  return results;
}

const CrossCheck* Find(const std::vector<CrossCheck>& checks, const std::string& name) {
  const auto found = std::ranges::find(checks, name, &CrossCheck::name);
  return found == checks.end() ? nullptr : &*found;
}

/// What page and report say of limits agrees with what is said of the checks.
void ExpectLevelsToFitLimits(const JobReport& report) {
  for (const CrossCheck& check : report.checks) {
    if (check.limit == 0.0) continue;
    EXPECT_EQ(check.IsWithinLimit(), check.level == CheckLevel::kGood)
        << check.name << " " << check.value << " " << check.limit << ": " << check.sentence;
  }
}

JobReport Reported(const JobResults& results) {
  JobReport report = BuildJobReport(results);
  ExpectLevelsToFitLimits(report);
  return report;
}

CheckLevel LevelOf(const JobReport& report, const std::string& name) {
  const CrossCheck* check = Find(report.checks, name);
  EXPECT_NE(check, nullptr) << name;
  return check == nullptr ? CheckLevel::kBad : check->level;
}

TEST(JudgeModel, ARightStreetIsGoodAndGivesNoReasons) {
  for (const bool on_earth : {false, true}) {
    const JobReport report = Reported(Street(36, {{0, 36}}, on_earth));
    EXPECT_EQ(report.verdict.level, CheckLevel::kGood);
    EXPECT_THAT(report.verdict.reasons, IsEmpty());
    for (const CrossCheck& check : report.checks) {
      EXPECT_EQ(check.level, CheckLevel::kGood) << check.name;
      EXPECT_FALSE(check.sentence.empty()) << check.name;
    }
  }
}

TEST(JudgeModel, ImagesLeftOutMakeItDoubtfulThenBad) {
  CheckLevel last = CheckLevel::kGood;
  for (uint32_t registered = 36; registered > 1; --registered) {
    const Verdict verdict = Reported(Street(36, {{0, registered}})).verdict;
    EXPECT_GE(verdict.level, last) << "more lost is no better: " << registered;
    EXPECT_EQ(verdict.reasons.empty(), verdict.level == CheckLevel::kGood);
    last = verdict.level;
  }
  EXPECT_EQ(Reported(Street(36, {{0, 35}})).verdict.level, CheckLevel::kGood)
      << "one image is no sign of more";
  const Verdict doubtful = Reported(Street(36, {{0, 31}})).verdict;
  EXPECT_EQ(doubtful.level, CheckLevel::kDoubtful);
  EXPECT_THAT(doubtful.reasons.front(), HasSubstr("31 of 36 panoramas are registered"));
  EXPECT_EQ(Reported(Street(36, {{0, 17}})).verdict.level, CheckLevel::kBad);
}

TEST(BuildJobReport, SaysWhatWasNotMatchedAsItGoesAlong) {
  JobResults results = Street(9, {{0, 9}});
  results.carriers = {{.images = {ImageId(2), ImageId(3)}, .cells = std::vector<uint32_t>(41)},
                      {.images = {ImageId(5), ImageId(6)}, .cells = std::vector<uint32_t>(1024)}};
  EXPECT_THAT(BuildJobReport(results).warnings,
              ElementsAre(AllOf(HasSubstr("up to 25.0 % of what it sees"),
                                HasSubstr("drives: 2, for example that of pano_5.jpg"),
                                HasSubstr("carrier_of_pano_2.png is one to begin with, --masks"))));
  results.carriers.resize(1);
  results.carriers[0].cells.resize(40);
  EXPECT_THAT(BuildJobReport(results).warnings, IsEmpty()) << "of less than a hundredth";
}

TEST(BuildJobReport, OffersMasksToDrivesWithoutAny) {
  JobResults results = Street(9, {{0, 9}});
  results.carriers = {{.images = {ImageId(2), ImageId(3)}, .cells = std::vector<uint32_t>(1024)},
                      {.images = {ImageId(5), ImageId(6)}, .cells = std::vector<uint32_t>(41)},
                      {.images = {ImageId(7), ImageId(8)}, .cells = std::vector<uint32_t>(40)}};
  results.manifest.images[3].mask = DigestOf("mask");
  results.manifest.images[5].name = "Monday/5.jpg";
  const JobReport report = BuildJobReport(results);
  ASSERT_EQ(report.carriers.size(), 1U);
  EXPECT_EQ(report.carriers[0].mask_file, "carrier_of_Monday_5.png");
  EXPECT_EQ(report.carriers[0].cells.size(), 41U);
  results.manifest.images[5].mask = DigestOf("mask");
  EXPECT_THAT(BuildJobReport(results).warnings,
              ElementsAre(HasSubstr("a mask over it (--masks FILE is")));
}

TEST(JudgeModel, OneImageLeftOutOfAFewIsWithinTheLimit) {
  const JobReport report = Reported(Street(9, {{0, 8}}));
  EXPECT_EQ(LevelOf(report, "images_registered"), CheckLevel::kGood);
  EXPECT_EQ(Find(report.checks, "images_registered")->limit, 8.0 / 9.0);
  EXPECT_EQ(LevelOf(Reported(Street(9, {{0, 7}})), "images_registered"), CheckLevel::kDoubtful);
}

TEST(JudgeModel, NoModelIsBad) {
  const Verdict verdict = Reported(Street(12, {})).verdict;
  EXPECT_EQ(verdict.level, CheckLevel::kBad);
  ASSERT_EQ(verdict.reasons.size(), 1U);
  EXPECT_THAT(verdict.reasons.front(), HasSubstr("no panorama"));
  EXPECT_EQ(JudgeModel({}).level, CheckLevel::kBad) << "nor is an empty report good";
}

TEST(JudgeModel, SaysWhatNothingCouldCheck) {
  JobResults free = Street(36, {{0, 36}});
  EXPECT_THAT(
      Reported(free).verdict.unchecked,
      ElementsAre(
          "the lengths of the steps along the street, but by rays that several pairs share: no "
          "GNSS tells them"));
  JobResults on_earth = Street(36, {{0, 36}}, true);
  EXPECT_THAT(Reported(on_earth).verdict.unchecked,
              ElementsAre(HasSubstr("whether a vehicle can have made the steps: they have no")));
  for (ImageRecord& image : on_earth.manifest.images) image.capture_time_s = 2.0 * image.id.value;
  EXPECT_THAT(Reported(on_earth).verdict.unchecked, IsEmpty());
  on_earth.models[0].report.checks = {
      {.name = "gnss_clock", .sentence = "a shift is taken off"},
      {.name = "gnss_clock", .sentence = "a shift of drive 1 cannot be told", .is_told = false},
      {.name = "gnss_clock", .sentence = "a shift of drive 2 cannot be told", .is_told = false}};
  EXPECT_THAT(Reported(on_earth).verdict.unchecked,
              ElementsAre("a shift of drive 1 cannot be told; 1 more like it"));
  on_earth.models[0].report.checks.clear();
  on_earth.manifest.images[7].capture_time_s.reset();
  EXPECT_THAT(Reported(on_earth).verdict.unchecked,
              ElementsAre(HasSubstr("of 1 of 36 registered panoramas: they have no")));
  JobResults both = Street(36, {{0, 30}, {30, 36}}, true);
  both.models[1].report.gnss.used = false;
  EXPECT_THAT(Reported(both).verdict.unchecked.front(),
              HasSubstr("of 6 of 36 registered panoramas along the street"));
  EXPECT_THAT(Reported(Street(36, {})).verdict.unchecked, IsEmpty());
}

TEST(JudgeModel, ASideModelOfAFreeStreetIsDoubtfulAndManyAreBad) {
  const JobReport two = Reported(Street(40, {{0, 30}, {30, 40}}));
  EXPECT_EQ(two.verdict.level, CheckLevel::kDoubtful);
  EXPECT_EQ(LevelOf(two, "images_in_one_frame"), CheckLevel::kDoubtful);
  EXPECT_EQ(LevelOf(two, "connected_in_one_model"), CheckLevel::kDoubtful);
  EXPECT_EQ(LevelOf(two, "images_registered"), CheckLevel::kGood);
  const JobReport many = Reported(Street(40, {{0, 14}, {14, 27}, {27, 40}}));
  EXPECT_EQ(many.verdict.level, CheckLevel::kBad);
  EXPECT_THAT(many.verdict.reasons.front(), HasSubstr("14 of 40 registered panoramas lie in one"));
}

TEST(JudgeModel, ModelsThatGnssPutsIntoOneFrameAreOneMapButAPartThatFellApartIsTold) {
  JobResults results = Street(40, {{0, 20}, {20, 40}}, true);
  const JobReport apart = Reported(results);
  EXPECT_EQ(LevelOf(apart, "images_in_one_frame"), CheckLevel::kGood);
  EXPECT_THAT(Find(apart.checks, "images_in_one_frame")->sentence,
              HasSubstr("2 models joined by GNSS alone"));
  EXPECT_EQ(LevelOf(apart, "connected_in_one_model"), CheckLevel::kDoubtful);
  // Two streets that no pair joins are two models by right.
  std::erase_if(results.view_graph.edges,
                [](const ImagePair& pair) { return pair.b == ImageId(20); });
  EXPECT_EQ(Reported(results).verdict.level, CheckLevel::kGood);
}

TEST(JudgeModel, GnssThatMostlyDisagreesIsDoubted) {
  JobResults results = Street(40, {{0, 40}}, true);
  GnssReport& gnss = results.models.front().report.gnss;
  gnss = {.used = true, .num_priors = 40, .num_inliers = 30};
  EXPECT_EQ(LevelOf(Reported(results), "gnss_used"), CheckLevel::kGood);
  gnss.num_inliers = 26;
  JobReport report = Reported(results);
  EXPECT_EQ(LevelOf(report, "gnss_used"), CheckLevel::kDoubtful);
  EXPECT_THAT(Find(report.checks, "gnss_used")->sentence, HasSubstr("or the model is where"));
  gnss.num_inliers = 15;
  report = Reported(results);
  EXPECT_EQ(LevelOf(report, "gnss_used"), CheckLevel::kDoubtful);
  EXPECT_THAT(Find(report.checks, "gnss_used")->sentence, HasSubstr("follows the fewer"));
}

TEST(JudgeModel, GnssThatAgreesAtTenTimesItsSigmaIsDoubted) {
  JobResults results = Street(40, {{0, 40}}, true);
  for (ImageRecord& image : results.manifest.images) {
    image.prior.horizontal_sigma_m = 2.0;
    image.prior.vertical_sigma_m = 4.0;
  }
  GnssReport& gnss = results.models.front().report.gnss;
  gnss = {.used = true, .num_priors = 40, .num_inliers = 40, .residual_median_m = 5.0};
  EXPECT_EQ(LevelOf(Reported(results), "gnss_used"), CheckLevel::kGood);
  gnss.residual_median_m = 20.0;
  const JobReport report = Reported(results);
  EXPECT_EQ(LevelOf(report, "gnss_used"), CheckLevel::kDoubtful);
  EXPECT_THAT(Find(report.checks, "gnss_used")->sentence, HasSubstr("20.0 m from it"));
}

TEST(JudgeModel, GnssThatIsGivenAndNotUsedIsDoubtedUnlessItCouldNotTell) {
  JobResults results = Street(40, {{0, 40}}, true);
  GnssReport& gnss = results.models.front().report.gnss;
  gnss = {.used = false, .reason = "GNSS scatters by 65 m"};
  JobReport report = Reported(results);
  EXPECT_EQ(report.verdict.level, CheckLevel::kDoubtful);
  EXPECT_THAT(report.verdict.reasons.front(), HasSubstr("40 GNSS positions are not used"));
  EXPECT_THAT(report.verdict.reasons.front(), HasSubstr("either they are wrong or the model is"));
  // Positions that differ by less than their noise say nothing of a model.
  for (ImageRecord& image : results.manifest.images) image.prior.horizontal_sigma_m = 50.0;
  EXPECT_EQ(Reported(results).verdict.level, CheckLevel::kGood);
  for (ImageRecord& image : results.manifest.images) image.prior.horizontal_sigma_m = 2.0;
  gnss.reason = "switched off";
  report = Reported(results);
  EXPECT_EQ(report.verdict.level, CheckLevel::kGood);
  EXPECT_EQ(Find(report.checks, "gnss_used"), nullptr);
}

TEST(JudgeModel, AnAdjustmentThatStoppedEarlyIsDoubtedByWhatItsLastStepMoved) {
  JobResults results = Street(20, {{0, 20}});
  GlobalAdjustReport& model = results.models.front().report;
  model.adjustments.back().converged = false;
  model.accepted_costs = {{5000.0, 4000.0, 4000.0 - 0.5 * 20 * 9.0}};  // three sigmas each
  const JobReport report = Reported(results);
  EXPECT_EQ(report.verdict.level, CheckLevel::kDoubtful);
  EXPECT_NEAR(Find(report.checks, "adjustment_converged")->value, 3.0, 1e-9);
  model.accepted_costs = {{5000.0, 4000.0, 3999.9}};
  EXPECT_EQ(Reported(results).verdict.level, CheckLevel::kGood);
}

TEST(JudgeModel, UnknownUncertaintyIsDoubted) {
  JobResults results = Street(20, {{0, 20}});
  for (auto& [id, image] : results.models.front().images) image.uncertainty.reset();
  results.models.front().report.uncertainty = {.reason = "not positive definite"};
  const Verdict verdict = Reported(results).verdict;
  EXPECT_EQ(verdict.level, CheckLevel::kDoubtful);
  EXPECT_THAT(verdict.reasons.front(), HasSubstr("not positive definite"));
}

/// Four clusters in a row with certificates of these ratios of jump and noise; 0: none.
JobReport WithSeams(const std::vector<double>& ratios) {
  JobReport report = Reported(Street(40, {{0, 40}}));
  for (uint32_t i = 0; i < ratios.size(); ++i) {
    report.seams.push_back({.cluster_a = i, .cluster_b = i + 1});
    if (ratios[i] > 0.0)
      report.seams.back().after = {
          .images = 9, .position_jump_m = ratios[i], .position_noise_m = 1.0};
  }
  report.checks = CheckJob(Street(40, {{0, 40}}), report);
  report.verdict = JudgeModel(report);
  return report;
}

TEST(JudgeModel, SeamsAreDoubtedOneByOneAndBadTogether) {
  EXPECT_EQ(WithSeams({1.0, 0.4, 2.9}).verdict.level, CheckLevel::kGood);
  const Verdict one = WithSeams({1.0, 7.0, 2.0}).verdict;
  EXPECT_EQ(one.level, CheckLevel::kDoubtful);
  EXPECT_THAT(one.reasons.front(), HasSubstr("between clusters 1 and 2, is off by 7 times"));
  EXPECT_EQ(WithSeams({7.0}).verdict.level, CheckLevel::kDoubtful) << "there is no other";
  EXPECT_EQ(WithSeams({9.0, 7.0, 2.0}).verdict.level, CheckLevel::kBad);
}

TEST(JudgeModel, AClusterWithoutACertifiedSeamIsDoubted) {
  EXPECT_EQ(WithSeams({1.0, 0.0, 2.0}).verdict.level, CheckLevel::kGood)
      << "both clusters have another seam";
  const JobReport last = WithSeams({1.0, 2.0, 0.0});
  EXPECT_EQ(LevelOf(last, "clusters_certified"), CheckLevel::kDoubtful);
}

TEST(JudgeModel, ASeamThatLoopsContradictIsDoubted) {
  JobReport report = WithSeams({1.0, 1.0, 1.0});
  report.seams[1].used = false;
  EXPECT_EQ(Find(CheckJob(Street(40, {{0, 40}}), report), "seams_in_loops")->level,
            CheckLevel::kGood)
      << "too few common tracks contradict nothing";
  report.seams[1].contradicted = true;
  EXPECT_EQ(Find(CheckJob(Street(40, {{0, 40}}), report), "seams_in_loops")->level,
            CheckLevel::kDoubtful);
}

TEST(JudgeModel, LoopsThatBendClustersByMoreThanIsExpectedAreDoubted) {
  JobReport report = WithSeams({1.0, 1.0, 1.0});
  report.seams[1].drift_factor = 7.9;
  const auto check = Find(CheckJob(Street(40, {{0, 40}}), report), "seams_in_loops");
  EXPECT_EQ(check->level, CheckLevel::kDoubtful);
  EXPECT_NE(check->sentence.find("bent by 7.9 times"), std::string::npos) << check->sentence;
}

/// Two models on earth of a street in two parts, with a check each.
TEST(CheckJob, DoubtsASmallerModelThatItsPositionsPutWhereMostOfThemAreNot) {
  JobResults results = Street(60, {{0, 40}, {40, 60}}, true);
  const auto doubts = [&results] {
    const JobReport report = Reported(results);
    return std::ranges::count_if(report.checks, [](const CrossCheck& check) {
      return check.name == "gnss_used" && check.level == CheckLevel::kDoubtful;
    });
  };
  EXPECT_EQ(doubts(), 0);
  results.models[1].report.gnss.num_inliers = 13;
  EXPECT_EQ(doubts(), 1);
  EXPECT_THAT(Find(Reported(results).checks, "gnss_used")->sentence, HasSubstr("40 of 40"));
}

JobResults TwoParts(uint32_t first) {
  JobResults results = Street(60, {{0, first}, {first, 60}}, true);
  std::erase_if(results.view_graph.edges,
                [&](const ImagePair& pair) { return pair.b == ImageId(first); });
  results.models[0].report.checks = {
      {"steps", 9.0, 3.0, "m", CheckLevel::kDoubtful, "the step to pano_7.jpg is 9 m"},
      {"fine", 1.0, 3.0, "m", CheckLevel::kGood, "fine"}};
  results.models[1].report.checks = {
      {"clock", 2.0, 0.3, "s", CheckLevel::kBad, "the clock is 2 s late"},
      {"steps", 8.0, 3.0, "m", CheckLevel::kDoubtful, "the step to pano_39.jpg is 8 m"}};
  return results;
}

TEST(JudgeModel, TakesTheWorstCheckOfAnyModelAndGivesReasonsWorstFirst) {
  const Verdict verdict = Reported(TwoParts(40)).verdict;
  EXPECT_EQ(verdict.level, CheckLevel::kBad);
  ASSERT_EQ(verdict.reasons.size(), 2U);
  EXPECT_EQ(verdict.reasons[0], "model 1: the clock is 2 s late");
  EXPECT_EQ(verdict.reasons[1], "model 0: the step to pano_7.jpg is 9 m (and 1 more of this kind)");
}

TEST(JudgeModel, AModelOfAHandfulOfImagesMakesAJobDoubtfulAtMost) {
  const Verdict verdict = Reported(TwoParts(58)).verdict;
  EXPECT_EQ(verdict.level, CheckLevel::kDoubtful);
  EXPECT_THAT(verdict.reasons[1], HasSubstr("the clock"));
}

TEST(JudgeModel, SaysWhyMostImagesAreLeftOut) {
  JobResults results = Street(30, {});
  results.clusters = {{}};
  results.view_graph.partition.clusters = {{}};
  for (uint32_t i = 0; i < 30; ++i)
    results.clusters[0].not_registered.push_back({ImageId(i), "the camera never moved"});
  const Verdict verdict = Reported(results).verdict;
  EXPECT_EQ(verdict.level, CheckLevel::kBad);
  EXPECT_THAT(verdict.reasons[0], HasSubstr("30 images: the camera never moved, first pano_0.jpg"));
}

std::optional<CrossCheck> PairsChecked(const JobResults& results) {
  return CheckContradictedPairs(results, JudgePairsOfJob(results), BorneOutByGnss(results));
}

TEST(CheckContradictedPairs, CountsPairsWithinOneModelAlone) {
  JobResults results = Street(40, {{0, 30}, {30, 40}});
  ASSERT_EQ(results.view_graph.edges.size(), 39U);
  EXPECT_EQ(PairsChecked(results)->value, 0.0);
  // Pairs between two models are no witnesses; those that the view graph lost still are.
  results.clusters = {{.contradicted_pairs = {ImagePair{ImageId(29), ImageId(30)},
                                              ImagePair{ImageId(3), ImageId(4)}}},
                      {.cluster = 1,
                       .contradicted_pairs = {ImagePair{ImageId(3), ImageId(4)},
                                              ImagePair{ImageId(5), ImageId(9)},
                                              ImagePair{ImageId(6), ImageId(9)}}}};
  const CrossCheck check = *PairsChecked(results);
  EXPECT_DOUBLE_EQ(check.value, 3.0 / 40.0);
  EXPECT_EQ(check.level, CheckLevel::kDoubtful);
  EXPECT_THAT(check.sentence,
              HasSubstr("3 of 40 verified pairs contradict the model, first pano_3"));
  EXPECT_THAT(check.sentence, HasSubstr("of 4 pairs of pano_9.jpg 2"));
  for (uint32_t i = 1; i < 30; ++i)
    results.clusters[0].contradicted_pairs.push_back({ImageId(i - 1), ImageId(i)});
  EXPECT_EQ(PairsChecked(results)->level, CheckLevel::kBad);
  EXPECT_EQ(PairsChecked(Street(5, {})), std::nullopt);
}

TEST(CheckContradictedPairs, ScatteredLookAlikesAreNoReasonForDoubt) {
  JobResults results = Street(40, {{0, 40}});
  results.clusters = {{}};
  for (uint32_t i = 0; i < 8; ++i)
    results.clusters[0].contradicted_pairs.push_back({ImageId(2 * i), ImageId(20 + 2 * i)});
  const CrossCheck check = *PairsChecked(results);
  EXPECT_DOUBLE_EQ(check.value, 8.0 / 47.0);
  EXPECT_EQ(check.level, CheckLevel::kGood);
  EXPECT_THAT(check.sentence, HasSubstr("most pairs of every panorama agree with it"));
}

TEST(BuildJobReport, HasARowForEveryModelAndPlacesMissingImagesByGnss) {
  JobResults results = Street(40, {{0, 20}, {25, 40}}, true);
  results.manifest.origin = GeodeticPosition{47.0, 8.0, 400.0};
  results.models[1].images[ImageId(30)].loose = true;
  const JobReport report = Reported(results);
  ASSERT_EQ(report.each_model.size(), 2U);
  EXPECT_EQ(report.each_model[0].images, 20U);
  EXPECT_EQ(report.each_model[1].images, 14U);
  EXPECT_EQ(report.each_model[1].loose, 1U);
  EXPECT_TRUE(report.each_model[1].uncertainty.known);
  EXPECT_DOUBLE_EQ(report.each_model[0].step_median, 3.0);
  EXPECT_DOUBLE_EQ(report.each_model[0].path_length, 57.0);
  EXPECT_TRUE(report.origin.has_value());
  EXPECT_FALSE(report.images[22].registered);
  EXPECT_EQ(report.images[22].gnss_in_world, results.manifest.images[22].prior.position_in_enu);
  EXPECT_EQ(report.images[30].StateText(), "loose");
  EXPECT_EQ(report.images[27].model, 1U);
}

}  // namespace
}  // namespace orbweave
