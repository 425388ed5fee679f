// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// The rounds of matching: the stages as they are, but what is found of pairs is made up.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/graph/list_pair_candidates.h"
#include "stages/codecs.h"
#include "stages/extract_features/stage.h"
#include "stages/job_reader.h"
#include "stages/list_extractions/stage.h"
#include "stages/list_pairs/stage.h"
#include "stages/match_images/stage.h"
#include "stages/plan_builder.h"
#include "stages/plans.h"
#include "stages/registry.h"
#include "stages/run_plan.h"
#include "stages/select_wider_pairs/stage.h"
#include "tests/support/memory_blobs.h"

namespace orbweave {
namespace {

using testing::MemoryBlobs;
using Pairs = std::vector<ImagePair>;
using Finder = std::function<MatchedPair(const ImagePair&)>;

constexpr uint32_t kImages = 60;

struct MatchingJob {
  static constexpr std::string_view kKind = "matching";
  One<ImageManifest> manifest;
  One<PairCandidates> candidates;
  One<std::vector<Carrier>> carriers;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &MatchingJob::manifest);
    visit("candidates", &MatchingJob::candidates);
    visit("carriers", &MatchingJob::carriers);
  }
};

JobPlan MatchingPlan() {
  PlanBuilder plan(MatchingJob::kKind);
  const auto job = InputsOf<MatchingJob>();
  const auto wider = RoundBefore(OutputsOf<SelectWiderPairsStage>().wider);
  const auto images = plan.Add(ListExtractionsStage{.manifest = job.manifest, .wider = wider});
  const auto extracted = plan.Add(ExtractFeaturesStage{.image = images.images});
  const auto listed =
      plan.Add(ListPairsStage{.candidates = job.candidates,
                              .carriers = job.carriers,
                              .features = Interleave(extracted.features, extracted.places),
                              .wider = wider});
  const auto matched = plan.Add(MatchImagesStage{.run = listed.runs});
  plan.Add(SelectWiderPairsStage{.manifest = job.manifest,
                                 .candidates = job.candidates,
                                 .matched = matched.matched,
                                 .before = wider});
  plan.RepeatFrom<ListExtractionsStage>(1.0, 5);
  return std::move(plan).Finish();
}

ImageManifest Drive() {
  ImageManifest manifest;
  for (uint32_t i = 0; i < kImages; ++i) {
    ImageRecord& image = manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = std::to_string(i) + ".jpg";
    image.camera = {2048, 1024};
    image.content = DigestOf(image.name);
  }
  return manifest;
}

/// A drive whose pairs show what `find` says.
class Matching {
 public:
  explicit Matching(Finder find) : find_(std::move(find)) {
    const ImageManifest manifest = Drive();
    candidates_ = ListPairCandidates(manifest, {}, 0, {});
    job_ = {
        .kind = std::string(MatchingJob::kKind),
        .inputs = JobInputs<MatchingJob>()
                      .Set(&MatchingJob::manifest, PutBlob(manifest, blobs_).value())
                      .Set(&MatchingJob::candidates, PutBlob(candidates_, blobs_).value())
                      .Set(&MatchingJob::carriers, PutBlob(std::vector<Carrier>{}, blobs_).value())
                      .InOrder()};
  }

  void Run() {
    const StageFunction match = [this](const TaskSpec& spec,
                                       BlobAccess& blobs,
                                       const StageContext& context) {
      return RunTaskOf<MatchImagesStage>(
          spec, blobs, context, [this](StageTask<MatchImagesStage>& task) { return Match(task); });
    };
    const StageFunction extract =
        [this](const TaskSpec& spec, BlobAccess& blobs, const StageContext& context) {
          return RunTaskOf<ExtractFeaturesStage>(
              spec, blobs, context, [this](StageTask<ExtractFeaturesStage>& task) {
                return Extract(task);
              });
        };
    const auto find_stage = [&](std::string_view name) {
      if (name == ExtractFeaturesStage::kFacts.name) return &extract;
      return name == MatchImagesStage::kFacts.name ? &match : FindStageFunction(name);
    };
    auto outcomes = RunPlan(plan_, job_, find_stage, blobs_, {});
    ASSERT_TRUE(outcomes.ok()) << outcomes.status();
    outcomes_ = *std::move(outcomes);
  }

  /// Of the tasks that the last round has, in their order.
  [[nodiscard]] std::vector<Pairs> Runs() {
    std::vector<Pairs> runs;
    for (const MatchRecipe& recipe : Recipes()) {
      Pairs& pairs = runs.emplace_back();
      for (const MatchRecipe::Pair& pair : recipe.pairs) pairs.push_back(pair.pair);
    }
    return runs;
  }
  /// Whether all features that the last round matches have those of facade views.
  [[nodiscard]] bool MatchesFacades() {
    const std::vector<MatchRecipe> recipes = Recipes();
    return std::ranges::all_of(recipes, [&](const MatchRecipe& recipe) {
      return std::ranges::all_of(recipe.images, [&](const FeatureFile& file) {
        return !FetchBlob<Features>(file.features, blobs_).value().view.empty();
      });
    });
  }
  [[nodiscard]] WiderPairs Wider() {
    return Reader().Read(&SelectWiderPairsStage::Outputs::wider).value();
  }
  [[nodiscard]] size_t CountMatched() {
    return Reader().List(&MatchImagesStage::Outputs::verified).value().size();
  }
  [[nodiscard]] const PairCandidates& candidates() const { return candidates_; }
  /// Pairs that came with what others predict of them.
  [[nodiscard]] const Pairs& again() const { return again_; }
  /// How often a task was done.
  [[nodiscard]] const std::multiset<Digest>& matchings() const { return matchings_; }
  [[nodiscard]] size_t num_extractions() const { return num_extractions_; }

 private:
  /// One feature; of the last facade view where these are wanted.
  absl::Status Extract(StageTask<ExtractFeaturesStage>& task) {
    ++num_extractions_;
    ORBWEAVE_ASSIGN_OR_RETURN(const ExtractRecipe recipe, task.Read(&ExtractFeaturesStage::image));
    Features features{.camera = {2048, 1024},
                      .keypoints = {{}},
                      .sigma_rad = {0.001F},
                      .descriptors = std::vector<uint8_t>(kDescriptorSize),
                      .colors = {{}}};
    if (recipe.wants_facades) features.view = {kNumFacadeViews};
    ORBWEAVE_RETURN_IF_ERROR(
        task.Leave(&ExtractFeaturesStage::Outputs::features, features).status());
    return task.Leave(&ExtractFeaturesStage::Outputs::places, PlaceSample{.num_features = 1})
        .status();
  }
  absl::Status Match(StageTask<MatchImagesStage>& task) {
    matchings_.insert(task.DigestOf(&MatchImagesStage::run));
    ORBWEAVE_ASSIGN_OR_RETURN(const MatchRecipe recipe, task.Read(&MatchImagesStage::run));
    std::vector<TwoViewGeometry> verified;
    std::vector<MatchedPair> matched;
    for (const MatchRecipe::Pair& pair : recipe.pairs) {
      if (pair.predicted) again_.push_back(pair.pair);
      MatchedPair found = find_(pair.pair);
      if (found.kind == TwoViewKind::kNone) continue;
      found.pair = pair.pair;
      matched.push_back(found);
      verified.push_back({.pair = pair.pair, .kind = found.kind});
    }
    ORBWEAVE_RETURN_IF_ERROR(task.Leave(&MatchImagesStage::Outputs::verified, verified).status());
    return task.Leave(&MatchImagesStage::Outputs::matched, matched).status();
  }
  [[nodiscard]] std::vector<MatchRecipe> Recipes() {
    const std::vector<Digest> digests =
        Reader().RecipesBehind(&SelectWiderPairsStage::matched).value();
    std::vector<MatchRecipe> recipes;
    for (const Digest& digest : digests)
      recipes.push_back(FetchBlob<MatchRecipe>(digest, blobs_).value());
    return recipes;
  }
  [[nodiscard]] JobReader Reader() { return JobReader(plan_, job_, outcomes_, blobs_); }

  Finder find_;
  MemoryBlobs blobs_{};
  JobPlan plan_ = MatchingPlan();
  PairCandidates candidates_{};
  JobSpec job_{};
  std::vector<TaskOutcome> outcomes_{};
  std::multiset<Digest> matchings_{};
  Pairs again_{};
  size_t num_extractions_ = 0;
};

MatchedPair Strong(const ImagePair&) {
  return {.kind = TwoViewKind::kGeneral,
          .num_moved = 300,
          .log10_false_alarms = -400.0,
          .b_from_a = {Eigen::Quaterniond::Identity(), -Eigen::Vector3d::UnitX()}};
}

Pairs Together(const std::vector<Pairs>& runs) {
  Pairs all;
  for (const Pairs& run : runs) all.insert(all.end(), run.begin(), run.end());
  return all;
}

TEST(MatchingRounds, MatchFewerPairsOfAStrongChain) {
  Matching matching(Strong);
  matching.Run();
  const Pairs all = Together(matching.Runs());
  EXPECT_EQ(all.size(), matching.candidates().first.size() + matching.Wider().second.size());
  EXPECT_GT(matching.Wider().num_held_back, matching.candidates().second.size() / 2);
  EXPECT_TRUE(matching.Wider().reserve.empty());
}

TEST(MatchingRounds, MatchMoreOfAStreetThatHangsTogetherBadly) {
  Matching matching([](const ImagePair&) { return MatchedPair{}; });
  matching.Run();
  const PairCandidates& candidates = matching.candidates();
  EXPECT_EQ(Together(matching.Runs()).size(),
            candidates.first.size() + candidates.second.size() + candidates.reserve.size());
  EXPECT_EQ(matching.Wider().num_thin_images, kImages);
}

/// What was found is read in the order of the rounds, each sorted, and no pair is found twice.
TEST(MatchingRounds, ListTheFirstPairsFirstAndEveryPairOnce) {
  Matching matching(
      [](const ImagePair& pair) { return pair.a.value < 20 ? MatchedPair{} : Strong(pair); });
  matching.Run();
  Pairs all = Together(matching.Runs());
  const PairCandidates& candidates = matching.candidates();
  ASSERT_GT(all.size(), candidates.first.size());
  EXPECT_TRUE(std::ranges::equal(candidates.first, std::span(all).first(candidates.first.size())));
  EXPECT_EQ(matching.CountMatched(), matching.Runs().size());
  EXPECT_FALSE(matching.Wider().reserve.empty());
  EXPECT_TRUE(std::ranges::equal(matching.Wider().reserve,
                                 std::span(all).last(matching.Wider().reserve.size())));
  std::ranges::sort(all);
  EXPECT_EQ(std::ranges::adjacent_find(all), all.end());
}

TEST(MatchingRounds, MatchAgainUnderWhatOtherPairsPredict) {
  Matching matching([](const ImagePair& pair) {
    return pair.b.value - pair.a.value == 1 ? Strong(pair) : MatchedPair{};
  });
  matching.Run();
  ASSERT_EQ(matching.again().size(), kImages - 2);
  EXPECT_EQ(matching.Wider().predicted.size(), kImages - 2);
  const std::vector<Pairs> runs = matching.Runs();
  size_t num_first = 0;
  for (size_t pairs = 0; pairs < matching.candidates().first.size(); ++num_first)
    pairs += runs[num_first].size();
  EXPECT_EQ(matching.matchings().size(), runs.size() + num_first) << "with facade views once more";
  EXPECT_EQ(runs.back().back(), matching.again().back()) << "they come last";
}

/// What the first pairs showed is matched again, and nothing else before.
TEST(MatchingRounds, TakeFacadeViewsWherePanoramasSeeTheNextAlone) {
  Matching matching([](const ImagePair& pair) {
    return pair.b.value - pair.a.value == 1 ? Strong(pair) : MatchedPair{};
  });
  matching.Run();
  EXPECT_TRUE(matching.Wider().wants_facades);
  EXPECT_TRUE(matching.MatchesFacades());
  EXPECT_EQ(matching.num_extractions(), 2 * kImages);

  Matching dense(Strong);
  dense.Run();
  EXPECT_FALSE(dense.Wider().wants_facades);
  EXPECT_FALSE(dense.MatchesFacades());
  EXPECT_EQ(dense.num_extractions(), kImages);
}

TEST(MatchingRounds, ComputeNoTaskTwice) {
  Matching matching(
      [](const ImagePair& pair) { return pair.a.value < 20 ? MatchedPair{} : Strong(pair); });
  matching.Run();
  const std::multiset<Digest>& done = matching.matchings();
  EXPECT_EQ(done.size(), matching.Runs().size());
  EXPECT_EQ(std::ranges::adjacent_find(done), done.end());
}

}  // namespace
}  // namespace orbweave
