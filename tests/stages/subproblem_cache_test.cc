// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/adjust_block/subproblem_cache.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/merging/divide_world.h"
#include "core/synthetic/make_corridor.h"
#include "proto/codec/adjustment_codec.h"
#include "proto/codec/subproblem_codec.h"
#include "stages/adjust_block/stage.h"
#include "stages/codecs.h"
#include "stages/pipeline_options.h"
#include "stages/steer_adjustment/advance_adjustment.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

class MemoryBlobs final : public BlobAccess {
 public:
  absl::StatusOr<std::string> Get(const Digest& digest) override {
    ++reads[digest];
    return blobs.at(digest);
  }
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    const Digest digest = DigestOf(bytes);
    blobs[digest] = std::string(bytes);
    return digest;
  }

  std::map<Digest, std::string> blobs{};
  std::map<Digest, int> reads{};
};

std::vector<Subproblem> MakeSubproblems() {
  const Corridor corridor = MakeCorridor({.panoramas = 70, .features_per_panorama = 120});
  Random random(5);
  Reconstruction model =
      testing::DisturbedModel(testing::TrueModel(corridor), 0.02, Sim3{}, random);
  std::map<ImageId, uint32_t> owners;
  for (const auto& [id, image] : model.images) owners[id] = id.value / 15;
  const Georeference georeference{
      .enu_from_world = Sim3{}, .horizontal_scatter_m = 1.0, .vertical_scatter_m = 2.0};
  return DivideWorld(std::move(model), 0, owners, georeference, corridor.manifest, 2.0);
}

std::string OptionsText() {
  return SelectSections(PipelineOptionsToText(PipelineOptions{}),
                        AdjustBlockStage::Options::Names());
}

TaskSpec TaskOf(const Digest& request) {
  return {.stage = "adjust_block",
          .version = std::string(AdjustBlockStage::kFacts.version),
          .inputs = {request},
          .options_text = OptionsText()};
}

absl::StatusOr<TaskResult> RunAdjustBlock(const TaskSpec& spec,
                                          BlobAccess& blobs,
                                          SubproblemCache& cache) {
  return RunTaskOf<AdjustBlockStage>(spec, blobs, {}, [&](StageTask<AdjustBlockStage>& task) {
    return AdjustBlockStage::RunWith(cache, task);
  });
}

/// All results of a whole adjustment, round by round. `process_of` says which of `processes` does a
/// subproblem's share of a round.
template <typename ProcessOf>
std::vector<Digest> Adjust(MemoryBlobs& blobs,
                           std::vector<SubproblemCache*> processes,
                           ProcessOf process_of) {
  std::vector<SubproblemPlace> places;
  for (const Subproblem& subproblem : MakeSubproblems())
    places.push_back({.subproblem = *blobs.Put(EncodeSubproblem(subproblem).value())});
  AdvancedAdjustment advanced = StartAdjustment(std::move(places), {1}, {}, {});
  std::vector<Digest> outputs;
  for (uint32_t round = 0; !advanced.tasks.empty(); ++round) {
    std::vector<SubproblemResult> results;
    for (uint32_t part = 0; part < advanced.tasks.size(); ++part) {
      const TaskSpec spec = TaskOf(*PutBlob(advanced.tasks[part], blobs));
      const auto done = RunAdjustBlock(spec, blobs, *processes[process_of(round, part)]);
      EXPECT_TRUE(done.ok()) << done.status();
      results.push_back(*DecodeSubproblemResult(blobs.blobs.at(done->outputs[0])));
      outputs.insert(outputs.end(), done->outputs.begin(), done->outputs.end());
    }
    advanced = *AdvanceAdjustment(std::move(advanced.progress), std::move(results), {}, {});
  }
  return outputs;
}

size_t First(uint32_t, uint32_t) { return 0; }

TEST(SubproblemCache, GiveTheBytesOfSubproblemsMadeAnew) {
  MemoryBlobs blobs;
  SubproblemCache none(0);
  const std::vector<Digest> anew = Adjust(blobs, {&none}, First);
  ASSERT_GT(anew.size(), 50U);
  SubproblemCache all(1000000);
  EXPECT_EQ(Adjust(blobs, {&all}, First), anew);
}

TEST(SubproblemCache, GiveTheSameBytesWhenSubproblemsWanderBetweenProcesses) {
  MemoryBlobs blobs;
  SubproblemCache none(0);
  const std::vector<Digest> anew = Adjust(blobs, {&none}, First);
  for (const uint32_t stride : {1U, 3U, 5U}) {
    SubproblemCache one(1000000);
    SubproblemCache two(1000000);
    const auto wander = [stride](uint32_t round, uint32_t part) -> size_t {
      return (stride * round + part * part) / 2 % 2;
    };
    EXPECT_EQ(Adjust(blobs, {&one, &two}, wander), anew) << stride;
  }
}

TEST(SubproblemCache, AreReadOnceAndOnlyAsManyAsThereIsRoomFor) {
  MemoryBlobs blobs;
  size_t observations = 0;
  std::vector<Digest> first;
  for (const Subproblem& subproblem : MakeSubproblems()) {
    observations += subproblem.scene.NumObservations();
    for (const SplitTrack& track : subproblem.split) observations += track.part.observations.size();
    first.push_back(*blobs.Put(EncodeSubproblem(subproblem).value()));
  }
  SubproblemCache all(observations);
  (void)Adjust(blobs, {&all}, First);
  for (const Digest& subproblem : first) EXPECT_EQ(blobs.reads[subproblem], 1);

  blobs.reads.clear();
  SubproblemCache half(observations / 2);
  (void)Adjust(blobs, {&half}, First);
  size_t read_once = 0;
  for (const Digest& subproblem : first) read_once += blobs.reads[subproblem] == 1 ? 1 : 0;
  EXPECT_GE(read_once, 1U);
  EXPECT_LT(read_once, first.size());
}

TEST(SubproblemCache, OfOtherOptionsAreNotTaken) {
  MemoryBlobs blobs;
  SubproblemCache cache(1000000);
  const SubproblemTask begin{.subproblem =
                                 *blobs.Put(EncodeSubproblem(MakeSubproblems().front()).value())};
  const TaskSpec spec = TaskOf(*PutBlob(begin, blobs));
  const auto done = RunAdjustBlock(spec, blobs, cache);
  ASSERT_TRUE(done.ok());
  const SubproblemTask next{
      .subproblem = begin.subproblem,
      .state = DecodeSubproblemResult(blobs.blobs.at(done->outputs[0]))->state,
      .request = {.work = LmRequest::Work::kLinearise}};
  EXPECT_FALSE(cache.Take(next, "others").has_value());
  ASSERT_TRUE(RunAdjustBlock(spec, blobs, cache).ok());
  EXPECT_TRUE(cache.Take(next, spec.options_text).has_value());
  EXPECT_FALSE(cache.Take(next, spec.options_text).has_value()) << "it was the caller's";
}

}  // namespace
}  // namespace orbweave
