// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/select_wider_pairs/stage.h"

#include <nlohmann/json.hpp>

#include "core/artifacts/check_bounds.h"
#include "core/graph/choose_wider_pairs.h"
#include "core/graph/see_few_others.h"
#include "stages/codecs.h"
#include "stages/list_extractions/wants_facades.h"

namespace orbweave {
namespace {

using Task = StageTask<SelectWiderPairsStage>;

absl::Status CheckCandidates(const PairCandidates& candidates, size_t num_images) {
  for (const std::vector<ImagePair>* pairs :
       {&candidates.first, &candidates.second, &candidates.reserve})
    ORBWEAVE_RETURN_IF_ERROR(CheckPairNumbers(*pairs, num_images));
  return absl::OkStatus();
}

/// Of all parts, one blob open at a time.
absl::StatusOr<std::vector<MatchedPair>> CollectMatched(size_t num_images, Task& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> blobs,
                            task.Read(&SelectWiderPairsStage::matched));
  std::vector<MatchedPair> all;
  for (const Digest& digest : blobs) {
    ORBWEAVE_ASSIGN_OR_RETURN(const auto part, task.Fetch<std::vector<MatchedPair>>(digest));
    for (const MatchedPair& pair : part) {
      ORBWEAVE_RETURN_IF_ERROR(BlameBlob(CheckPairNumbers({&pair.pair, 1}, num_images), digest));
      all.push_back(pair);
    }
  }
  return all;
}

/// Whether nobody has yet asked for features of facade views, and may.
bool MayWantFacades(const ImageManifest& manifest, const WiderPairs& before, const Task& task) {
  const ExtractOptions& options = task.options<ExtractOptions>();
  return before.decisions == 0 && !before.wants_facades && options.facades == UseFacades::kAuto &&
         !WantsFacades(manifest, options);
}

bool AskForMore(const WiderPairs& wider, const WiderPairs& before) {
  const auto count = [](const WiderPairs& pairs) {
    return pairs.second.size() + pairs.reserve.size() + pairs.predicted.size();
  };
  return wider.wants_facades != before.wants_facades || count(wider) > count(before);
}

}  // namespace

absl::Status SelectWiderPairsStage::Run(StageTask<SelectWiderPairsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            task.Read(&SelectWiderPairsStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const PairCandidates candidates,
                            task.Read(&SelectWiderPairsStage::candidates));
  ORBWEAVE_ASSIGN_OR_RETURN(const WiderPairs before, task.Read(&SelectWiderPairsStage::before));
  ORBWEAVE_RETURN_IF_ERROR(BlameBlob(CheckCandidates(candidates, manifest.images.size()),
                                     task.DigestOf(&SelectWiderPairsStage::candidates)));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<MatchedPair> matched,
                            CollectMatched(manifest.images.size(), task));
  WiderPairs wider = before;
  if (MayWantFacades(manifest, before, task) &&
      SeeFewOthers(manifest.images.size(), candidates.first, matched)) {
    wider.wants_facades = true;
  } else {
    wider = ChooseWiderPairs(manifest, candidates, matched, before, task.options<PairOptions>());
  }
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::wider, wider).status());
  if (AskForMore(wider, before))
    ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::another_round, wider));
  task.Report(nlohmann::json{{"facades", wider.wants_facades},
                             {"second", wider.second.size()},
                             {"held_back", wider.num_held_back},
                             {"reserve", wider.reserve.size()},
                             {"predicted", wider.predicted.size()},
                             {"thin_images", wider.num_thin_images}}
                  .dump());
  return absl::OkStatus();
}

}  // namespace orbweave
