// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_pairs/stage.h"

#include <nlohmann/json.hpp>

#include "core/artifacts/check_bounds.h"
#include "stages/codecs.h"
#include "stages/list_pairs/plan_matching.h"

namespace orbweave {
namespace {

/// Few enough that a lost task costs seconds, enough that neighbours share their Features.
constexpr size_t kPairsPerTask = 16;

}  // namespace

absl::Status ListPairsStage::Run(StageTask<ListPairsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PairCandidates candidates,
                            task.Read(&ListPairsStage::candidates));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Carrier> carriers,
                            task.Read(&ListPairsStage::carriers));
  ORBWEAVE_ASSIGN_OR_RETURN(const InterleavedDigests features,
                            task.Read(&ListPairsStage::features));
  ORBWEAVE_ASSIGN_OR_RETURN(const WiderPairs wider, task.Read(&ListPairsStage::wider));
  const size_t num_images = features.first.size();
  ORBWEAVE_RETURN_IF_ERROR(BlameBlob(CheckPairNumbers(candidates.first, num_images),
                                     task.DigestOf(&ListPairsStage::candidates)));
  for (const std::vector<ImagePair>* pairs : {&wider.second, &wider.reserve})
    ORBWEAVE_RETURN_IF_ERROR(CheckPairNumbers(*pairs, num_images));
  size_t count = 0;
  const auto leave = [&](std::vector<MatchRecipe::Pair> listed) {
    count += listed.size();
    return task.LeaveAll(&Outputs::runs,
                         PlanMatching(std::move(listed), features.first, carriers, kPairsPerTask));
  };
  for (const std::vector<ImagePair>* pairs : {&candidates.first, &wider.second, &wider.reserve}) {
    std::vector<MatchRecipe::Pair> listed;
    for (const ImagePair& pair : *pairs) listed.push_back({.pair = pair});
    ORBWEAVE_RETURN_IF_ERROR(leave(std::move(listed)));
  }
  std::vector<MatchRecipe::Pair> again;
  for (const PredictedPair& predicted : wider.predicted) {
    ORBWEAVE_RETURN_IF_ERROR(CheckPairNumbers({&predicted.pair, 1}, num_images));
    again.push_back({.pair = predicted.pair, .predicted = predicted.pose});
  }
  ORBWEAVE_RETURN_IF_ERROR(leave(std::move(again)));
  task.Report(nlohmann::json{{"pairs", count}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
