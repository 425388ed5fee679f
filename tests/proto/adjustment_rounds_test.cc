// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/merging/divide_world.h"
#include "core/partitioned_ba/adjust_subproblems.h"
#include "core/synthetic/corridor_options.h"
#include "core/synthetic/make_corridor.h"
#include "proto/codec/adjustment_codec.h"
#include "proto/codec/subproblem_codec.h"
#include "stages/steer_adjustment/advance_adjustment.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

/// A corridor as clusters and their alignment hand it over, in subproblems of 15 panoramas.
std::vector<Subproblem> MakeSubproblems(CorridorOptions options, bool uses_gnss) {
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
    const SubproblemTask task = *DecodeSubproblemTask(recipe);
    std::optional<EvaluatedState> state;
    if (!task.state.IsZero()) state = *DecodeSubproblemState(Get(task.state));
    SubproblemSolver worker(
        *DecodeSubproblem(Get(task.subproblem)), std::move(state), SubproblemOptions{}, 1);
    SubproblemResult result{.reply = worker.Execute(task.request)};
    result.state = Put(EncodeSubproblemState(worker.state()).value());
    result.subproblem = Put(EncodeSubproblem(worker.subproblem()).value());
    if (task.request.work == LmRequest::Work::kLinearise) result.state = {};
    return EncodeSubproblemResult(result).value();
  }

 private:
  std::map<Digest, std::string> blobs_;
};

std::vector<std::string> AdjustThroughBytes(const std::vector<Subproblem>& subproblems) {
  BytesOnly others;
  std::vector<SubproblemPlace> places;
  for (const Subproblem& subproblem : subproblems)
    places.push_back({.subproblem = others.Put(EncodeSubproblem(subproblem).value())});
  AdvancedAdjustment round = StartAdjustment(std::move(places), {1}, {}, {});
  while (!round.tasks.empty()) {
    std::vector<SubproblemResult> results;
    for (const SubproblemTask& task : round.tasks)
      results.push_back(*DecodeSubproblemResult(others.Run(EncodeSubproblemTask(task).value())));
    AdjustmentProgress progress =
        *DecodeAdjustmentProgress(EncodeAdjustmentProgress(round.progress).value());
    round = *AdvanceAdjustment(std::move(progress), std::move(results), {}, {});
  }
  std::vector<std::string> adjusted;
  for (const SubproblemPlace& place : round.progress.subproblems)
    adjusted.push_back(others.Get(place.subproblem));
  return adjusted;
}

class AdjustmentRounds : public ::testing::TestWithParam<std::pair<CorridorShape, bool>> {};

TEST_P(AdjustmentRounds, GiveTheBytesOfOneProcessWhoeverComputesASubproblem) {
  const auto [shape, uses_gnss] = GetParam();
  const std::vector<Subproblem> subproblems = MakeSubproblems({.shape = shape}, uses_gnss);
  ASSERT_GE(subproblems.size(), 4U);
  const auto together = AdjustSubproblems(subproblems, {}, {}, {});
  ASSERT_TRUE(together.ok());
  const std::vector<std::string> apart = AdjustThroughBytes(subproblems);
  ASSERT_EQ(apart.size(), together->subproblems.size());
  for (size_t b = 0; b < apart.size(); ++b)
    EXPECT_EQ(apart[b], EncodeSubproblem(together->subproblems[b]).value()) << "block " << b;
}

INSTANTIATE_TEST_SUITE_P(Streets,
                         AdjustmentRounds,
                         ::testing::Values(std::pair(CorridorShape::kBends, true),
                                           std::pair(CorridorShape::kBends, false),
                                           std::pair(CorridorShape::kLoop, true),
                                           std::pair(CorridorShape::kGrid, false)));

}  // namespace
}  // namespace orbweave
