// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/merging/adjust_blocks.h"
#include "core/merging/divide_world.h"
#include "core/stages/advance_adjustment.h"
#include "proto/codec/adjustment_codec.h"
#include "proto/codec/block_codec.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

/// A corridor as clusters and their alignment hand it over, in blocks of 15 panoramas.
std::vector<WorldBlock> MakeBlocks(CorridorOptions options, bool uses_gnss) {
  options.panoramas = 70;
  options.features_per_panorama = 120;
  const Corridor corridor = MakeCorridor(options);
  Random random(5);
  Reconstruction model =
      testing::DisturbedModel(testing::TrueModel(corridor), 0.02, Sim3{}, random);
  std::map<ImageId, uint32_t> owners;
  for (const auto& [id, image] : model.images) owners[id] = id.value / 15;
  Georeference georeference{.reason = "none"};
  if (uses_gnss) {
    georeference = {
        .enu_from_world = Sim3{}, .horizontal_scatter_m = 1.0, .vertical_scatter_m = 2.0};
  }
  return DivideWorld(std::move(model), 0, owners, georeference, corridor.manifest, 2.0);
}

/// Every task is done by somebody who knows nothing but the bytes of its recipe and blobs.
class BytesOnly {
 public:
  Digest Put(const std::string& bytes) {
    blobs_[DigestOf(bytes)] = bytes;
    return DigestOf(bytes);
  }
  const std::string& Get(const Digest& digest) const { return blobs_.at(digest); }

  std::string Run(const std::string& recipe) {
    const BlockTask task = *DecodeBlockTask(recipe);
    std::optional<EvaluatedState> state;
    if (!task.state.IsZero()) state = *DecodeBlockState(Get(task.state));
    BlockWorker worker(*DecodeWorldBlock(Get(task.block)), std::move(state), BlockOptions{}, 1);
    BlockResult result{.answer = worker.Execute(task.order)};
    result.state = Put(EncodeBlockState(worker.state()));
    result.block = Put(EncodeWorldBlock(worker.block()));
    if (task.order.work == BlockOrder::Work::kLinearise) result.state = {};
    return EncodeBlockResult(result);
  }

 private:
  std::map<Digest, std::string> blobs_;
};

std::vector<std::string> AdjustThroughBytes(const std::vector<WorldBlock>& blocks) {
  BytesOnly others;
  std::vector<BlockPlace> places;
  for (const WorldBlock& block : blocks)
    places.push_back({.block = others.Put(EncodeWorldBlock(block))});
  AdvancedAdjustment round = StartAdjustment(std::move(places), {1}, {}, {});
  while (!round.tasks.empty()) {
    std::vector<BlockResult> results;
    for (const BlockTask& task : round.tasks)
      results.push_back(*DecodeBlockResult(others.Run(EncodeBlockTask(task))));
    AdjustmentProgress progress =
        *DecodeAdjustmentProgress(EncodeAdjustmentProgress(round.progress));
    round = *AdvanceAdjustment(std::move(progress), std::move(results), {}, {});
  }
  std::vector<std::string> adjusted;
  for (const BlockPlace& place : round.progress.blocks) adjusted.push_back(others.Get(place.block));
  return adjusted;
}

class AdjustmentRounds : public ::testing::TestWithParam<std::pair<CorridorShape, bool>> {};

TEST_P(AdjustmentRounds, GiveTheBytesOfOneProcessWhoeverComputesABlock) {
  const auto [shape, uses_gnss] = GetParam();
  const std::vector<WorldBlock> blocks = MakeBlocks({.shape = shape}, uses_gnss);
  ASSERT_GE(blocks.size(), 4U);
  const auto together = AdjustBlocks(blocks, {}, {}, {});
  ASSERT_TRUE(together.ok());
  const std::vector<std::string> apart = AdjustThroughBytes(blocks);
  ASSERT_EQ(apart.size(), together->blocks.size());
  for (size_t b = 0; b < apart.size(); ++b)
    EXPECT_EQ(apart[b], EncodeWorldBlock(together->blocks[b])) << "block " << b;
}

INSTANTIATE_TEST_SUITE_P(Streets,
                         AdjustmentRounds,
                         ::testing::Values(std::pair(CorridorShape::kBends, true),
                                           std::pair(CorridorShape::kBends, false),
                                           std::pair(CorridorShape::kLoop, true),
                                           std::pair(CorridorShape::kGrid, false)));

}  // namespace
}  // namespace orbweave
