// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/kept_blocks.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/merging/divide_world.h"
#include "core/stages/advance_adjustment.h"
#include "core/stages/pipeline_options.h"
#include "proto/codec/adjustment_codec.h"
#include "proto/codec/block_codec.h"
#include "tests/core/merging/corridor_model.h"
#include "worker/adjustment_stages.h"

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

std::vector<WorldBlock> MakeBlocks() {
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

std::string OptionsText() { return PipelineOptionsToText(PipelineOptions{}); }

/// All results of a whole adjustment, round by round. `process_of` says which of `processes` does a
/// block's share of a round.
template <typename ProcessOf>
std::vector<Digest> Adjust(MemoryBlobs& blobs,
                           std::vector<KeptBlocks*> processes,
                           ProcessOf process_of) {
  std::vector<BlockPlace> places;
  for (const WorldBlock& block : MakeBlocks())
    places.push_back({.block = *blobs.Put(EncodeWorldBlock(block))});
  AdvancedAdjustment advanced = StartAdjustment(std::move(places), {1}, {}, {});
  std::vector<Digest> outputs;
  for (uint32_t round = 0; !advanced.tasks.empty(); ++round) {
    std::vector<BlockResult> results;
    for (uint32_t part = 0; part < advanced.tasks.size(); ++part) {
      const TaskSpec spec{.stage = "adjust_block",
                          .inputs = {*blobs.Put(EncodeBlockTask(advanced.tasks[part]))},
                          .options_text = OptionsText()};
      const auto done = RunAdjustBlock(spec, blobs, {}, *processes[process_of(round, part)]);
      EXPECT_TRUE(done.ok()) << done.status();
      results.push_back(*DecodeBlockResult(blobs.blobs.at(done->outputs[0])));
      outputs.insert(outputs.end(), done->outputs.begin(), done->outputs.end());
    }
    advanced = *AdvanceAdjustment(std::move(advanced.progress), std::move(results), {}, {});
  }
  return outputs;
}

size_t First(uint32_t, uint32_t) { return 0; }

TEST(KeptBlocks, GiveTheBytesOfBlocksMadeAnew) {
  MemoryBlobs blobs;
  KeptBlocks none(0);
  const std::vector<Digest> anew = Adjust(blobs, {&none}, First);
  ASSERT_GT(anew.size(), 50U);
  KeptBlocks all(1000000);
  EXPECT_EQ(Adjust(blobs, {&all}, First), anew);
}

TEST(KeptBlocks, GiveTheSameBytesWhenBlocksWanderBetweenProcesses) {
  MemoryBlobs blobs;
  KeptBlocks none(0);
  const std::vector<Digest> anew = Adjust(blobs, {&none}, First);
  for (const uint32_t stride : {1U, 3U, 5U}) {
    KeptBlocks one(1000000);
    KeptBlocks two(1000000);
    const auto wander = [stride](uint32_t round, uint32_t part) -> size_t {
      return (stride * round + part * part) / 2 % 2;
    };
    EXPECT_EQ(Adjust(blobs, {&one, &two}, wander), anew) << stride;
  }
}

TEST(KeptBlocks, AreReadOnceAndOnlyAsManyAsThereIsRoomFor) {
  MemoryBlobs blobs;
  size_t observations = 0;
  std::vector<Digest> first;
  for (const WorldBlock& block : MakeBlocks()) {
    observations += block.scene.NumObservations();
    for (const SplitTrack& track : block.split) observations += track.part.observations.size();
    first.push_back(*blobs.Put(EncodeWorldBlock(block)));
  }
  KeptBlocks all(observations);
  (void)Adjust(blobs, {&all}, First);
  for (const Digest& block : first) EXPECT_EQ(blobs.reads[block], 1);

  blobs.reads.clear();
  KeptBlocks half(observations / 2);
  (void)Adjust(blobs, {&half}, First);
  size_t read_once = 0;
  for (const Digest& block : first) read_once += blobs.reads[block] == 1 ? 1 : 0;
  EXPECT_GE(read_once, 1U);
  EXPECT_LT(read_once, first.size());
}

TEST(KeptBlocks, OfOtherOptionsAreNotTaken) {
  MemoryBlobs blobs;
  KeptBlocks kept(1000000);
  const BlockTask begin{.block = *blobs.Put(EncodeWorldBlock(MakeBlocks().front()))};
  const TaskSpec spec{.stage = "adjust_block",
                      .inputs = {*blobs.Put(EncodeBlockTask(begin))},
                      .options_text = OptionsText()};
  const auto done = RunAdjustBlock(spec, blobs, {}, kept);
  ASSERT_TRUE(done.ok());
  const BlockTask next{.block = begin.block,
                       .state = DecodeBlockResult(blobs.blobs.at(done->outputs[0]))->state,
                       .order = {.work = BlockOrder::Work::kLinearise}};
  EXPECT_FALSE(kept.Take(next, "others").has_value());
  ASSERT_TRUE(RunAdjustBlock(spec, blobs, {}, kept).ok());
  EXPECT_TRUE(kept.Take(next, spec.options_text).has_value());
  EXPECT_FALSE(kept.Take(next, spec.options_text).has_value()) << "it was the caller's";
}

}  // namespace
}  // namespace orbweave
