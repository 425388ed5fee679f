// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "worker/stage_table.h"

#include <unistd.h>

#include <algorithm>
#include <map>
#include <string>
#include <thread>

#include "worker/adjustment_stages.h"
#include "worker/block_stages.h"
#include "worker/image_stages.h"
#include "worker/model_stages.h"
#include "worker/seam_stages.h"

namespace orbweave {

namespace {

/// Memory of a process for blocks between two half-steps: where every core has a worker, a quarter
/// of the machine's for all of them.
size_t KeptBytes() {
  const auto pages = static_cast<size_t>(std::max(0L, sysconf(_SC_PHYS_PAGES)));
  const auto page_bytes = static_cast<size_t>(std::max(0L, sysconf(_SC_PAGESIZE)));
  return pages * page_bytes / 4 / std::max(1U, std::thread::hardware_concurrency());
}

absl::StatusOr<TaskResult> AdjustBlockOfThisProcess(const TaskSpec& spec,
                                                    BlobAccess& blobs,
                                                    const StageContext& context) {
  static auto* const kKept = new KeptBlocks(KeptBytes() / KeptBlocks::kBytesPerObservation);
  return RunAdjustBlock(spec, blobs, context, *kKept);
}

}  // namespace

const StageFunction* FindStage(std::string_view stage) {
  static const auto* const kTable = new std::map<std::string, StageFunction, std::less<>>{
      {"ingest_images", RunIngestImages},
      {"extract_features", RunExtractFeatures},
      {"select_image_pairs", RunSelectImagePairs},
      {"match_images", RunMatchImages},
      {"verify_matches", RunMatchImages},
      {"partition_view_graph", RunPartitionViewGraph},
      {"reconstruct_cluster", RunReconstructCluster},
      {"list_seams", RunListSeams},
      {"fit_seams", RunFitSeams},
      {"align_submodels", RunAlignSubmodels},
      {"review_seams", RunReviewSeams},
      {"join_submodels", RunJoinSubmodels},
      {"assemble_block", RunAssembleBlock},
      {"steer_adjustment", RunSteerAdjustment},
      {"adjust_block", AdjustBlockOfThisProcess},
      {"conclude_adjustment", RunConcludeAdjustment},
  };
  const auto found = kTable->find(stage);
  return found == kTable->end() ? nullptr : &found->second;
}

}  // namespace orbweave
