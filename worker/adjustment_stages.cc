// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "worker/adjustment_stages.h"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/merging/adjust_blocks.h"
#include "core/merging/attach_loose_images.h"
#include "core/merging/inspect_block.h"
#include "core/stages/advance_adjustment.h"
#include "proto/codec/adjustment_codec.h"
#include "proto/codec/block_codec.h"
#include "proto/codec/inspection_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/two_view_codec.h"
#include "worker/stage_io.h"

namespace orbweave {
namespace {

absl::StatusOr<Digest> PutInspection(const WorldBlock& block,
                                     int num_threads,
                                     BlobAccess& blobs,
                                     TaskResult& result) {
  const BlockInspection inspection = InspectBlock(block, num_threads);
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeBlockInspection(inspection), blobs, result));
  return result.outputs.back();
}

absl::StatusOr<BlockPlace> AdjustedPlace(uint32_t world,
                                         const WorldBlock& block,
                                         BlockSummary summary,
                                         int num_threads,
                                         BlobAccess& blobs,
                                         TaskResult& result) {
  BlockPlace place{.world = world, .summary = std::move(summary)};
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeWorldBlock(block), blobs, result));
  place.block = result.outputs.back();
  ORBWEAVE_ASSIGN_OR_RETURN(place.inspection, PutInspection(block, num_threads, blobs, result));
  return place;
}

/// Where the blocks of a job are before the first round, world by world.
struct FirstRound {
  const PipelineOptions& options;
  const std::vector<JoinedWorld>& worlds;
  const std::vector<Digest>& blocks;
  BlobAccess& blobs;
  const StageContext& context;

  [[nodiscard]] bool IsDistributed(const JoinedWorld& world) const {
    return world.num_images >= static_cast<uint32_t>(options.blocks.distribute_from);
  }

  /// Adjusts a whole world; its blocks are added to `result` and `places`.
  absl::StatusOr<GlobalAdjustReport> AdjustHere(uint32_t world,
                                                size_t first,
                                                std::vector<BlockPlace>& places,
                                                TaskResult& result) const {
    std::vector<WorldBlock> own;
    for (size_t b = first; b < first + worlds[world].num_blocks; ++b) {
      ORBWEAVE_ASSIGN_OR_RETURN(own.emplace_back(), FetchBlob(blocks[b], blobs, DecodeWorldBlock));
    }
    ORBWEAVE_ASSIGN_OR_RETURN(
        AdjustedBlocks adjusted,
        AdjustBlocks(std::move(own), options.global, options.bundle, context));
    for (size_t b = 0; b < adjusted.blocks.size(); ++b) {
      ORBWEAVE_ASSIGN_OR_RETURN(places.emplace_back(),
                                AdjustedPlace(world,
                                              adjusted.blocks[b],
                                              std::move(adjusted.summaries[b]),
                                              context.num_threads,
                                              blobs,
                                              result));
    }
    return std::move(adjusted.report);
  }

  absl::StatusOr<AdvancedAdjustment> Run(TaskResult& result) const {
    std::vector<BlockPlace> places;
    std::vector<GlobalAdjustReport> reports(worlds.size());
    std::vector<uint8_t> is_distributed;
    size_t first = 0;
    for (uint32_t world = 0; world < worlds.size(); ++world) {
      is_distributed.push_back(IsDistributed(worlds[world]) ? 1 : 0);
      const size_t end = first + worlds[world].num_blocks;
      if (end > blocks.size())
        return absl::InvalidArgumentError("steer_adjustment: the blocks are of other worlds");
      if (is_distributed.back() != 0) {
        for (size_t b = first; b < end; ++b) places.push_back({.world = world, .block = blocks[b]});
      } else {
        ORBWEAVE_ASSIGN_OR_RETURN(reports[world], AdjustHere(world, first, places, result));
      }
      first = end;
    }
    AdvancedAdjustment advanced =
        StartAdjustment(std::move(places), is_distributed, options.global, options.bundle);
    for (uint32_t world = 0; world < worlds.size(); ++world) {
      if (is_distributed[world] == 0)
        advanced.progress.worlds[world].report = std::move(reports[world]);
    }
    return advanced;
  }
};

absl::StatusOr<AdvancedAdjustment> NextRound(AdjustmentProgress progress,
                                             const std::vector<Digest>& answers,
                                             const PipelineOptions& options,
                                             BlobAccess& blobs) {
  std::vector<BlockResult> results;
  for (const Digest& answer : answers) {
    ORBWEAVE_ASSIGN_OR_RETURN(results.emplace_back(), FetchBlob(answer, blobs, DecodeBlockResult));
  }
  return AdvanceAdjustment(std::move(progress), std::move(results), options.global, options.bundle);
}

/// The block of a task, from its blobs.
absl::StatusOr<BlockWorker> MakeWorker(const TaskSpec& spec,
                                       const BlockTask& task,
                                       BlobAccess& blobs,
                                       const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(WorldBlock block, FetchBlob(task.block, blobs, DecodeWorldBlock));
  std::optional<EvaluatedState> state;
  if (!task.state.IsZero()) {
    ORBWEAVE_ASSIGN_OR_RETURN(state, FetchBlob(task.state, blobs, DecodeBlockState));
  }
  return BlockWorker(std::move(block),
                     std::move(state),
                     BlockOptionsOf(options.global, options.bundle),
                     context.num_threads);
}

}  // namespace

absl::StatusOr<TaskResult> RunSteerAdjustment(const TaskSpec& spec,
                                              BlobAccess& blobs,
                                              const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JoinedWorld> worlds,
                            FetchInput(spec, 0, blobs, DecodeJoinedWorlds));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> blocks,
                            FetchInput(spec, 1, blobs, DecodeCollection));
  ORBWEAVE_ASSIGN_OR_RETURN(AdjustmentProgress progress,
                            FetchInput(spec, 2, blobs, DecodeAdjustmentProgress));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> answers,
                            FetchInput(spec, 3, blobs, DecodeCollection));
  TaskResult result;
  AdvancedAdjustment advanced;
  if (progress.worlds.empty()) {
    const FirstRound first{options, worlds, blocks, blobs, context};
    ORBWEAVE_ASSIGN_OR_RETURN(advanced, first.Run(result));
  } else {
    ORBWEAVE_ASSIGN_OR_RETURN(advanced, NextRound(std::move(progress), answers, options, blobs));
  }
  TaskResult leaves;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeAdjustmentProgress(advanced.progress), blobs, leaves));
  leaves.outputs.insert(leaves.outputs.end(), result.outputs.begin(), result.outputs.end());
  ORBWEAVE_RETURN_IF_ERROR(PutRecipes(advanced.tasks, EncodeBlockTask, blobs, leaves));
  leaves.report_json = nlohmann::json{{"blocks_asked", advanced.tasks.size()}}.dump();
  return leaves;
}

absl::StatusOr<TaskResult> RunAdjustBlock(const TaskSpec& spec,
                                          BlobAccess& blobs,
                                          const StageContext& context,
                                          KeptBlocks& kept) {
  ORBWEAVE_ASSIGN_OR_RETURN(const BlockTask task, FetchInput(spec, 0, blobs, DecodeBlockTask));
  std::optional<KeptBlocks::Ready> ready = kept.Take(task, spec.options_text);
  if (!ready) {
    ORBWEAVE_ASSIGN_OR_RETURN(BlockWorker worker, MakeWorker(spec, task, blobs, context));
    ready = KeptBlocks::Ready{std::move(worker), task.order};
  }
  BlockWorker& worker = ready->worker;
  BlockResult done{.answer = worker.Execute(ready->order)};
  using Work = BlockOrder::Work;
  TaskResult bulk;
  if (task.order.work == Work::kFilter) {
    ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeWorldBlock(worker.block()), blobs, bulk));
    done.block = bulk.outputs.back();
  }
  if (task.order.work == Work::kFilter && !task.order.begins_again) {
    ORBWEAVE_ASSIGN_OR_RETURN(done.inspection,
                              PutInspection(worker.block(), context.num_threads, blobs, bulk));
  }
  const bool begins = task.order.work == Work::kBegin || task.order.begins_again;
  if (begins || task.order.work == Work::kTry) {
    ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeBlockState(worker.state()), blobs, bulk));
    done.state = bulk.outputs.back();
  }
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeBlockResult(done), blobs, result));
  result.outputs.insert(result.outputs.end(), bulk.outputs.begin(), bulk.outputs.end());
  result.report_json = "{}";
  kept.Keep(task, done, spec.options_text, std::move(worker));
  return result;
}

absl::StatusOr<TaskResult> RunConcludeAdjustment(const TaskSpec& spec,
                                                 BlobAccess& blobs,
                                                 const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            FetchInput(spec, 0, blobs, DecodeImageManifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JoinedWorld> worlds,
                            FetchInput(spec, 1, blobs, DecodeJoinedWorlds));
  ORBWEAVE_ASSIGN_OR_RETURN(AdjustmentProgress progress,
                            FetchInput(spec, 2, blobs, DecodeAdjustmentProgress));
  ORBWEAVE_ASSIGN_OR_RETURN(const DividedViewGraph divided,
                            FetchInput(spec, 3, blobs, DecodeDividedViewGraph));
  ConcludedModel model;
  for (uint32_t world = 0; world < worlds.size(); ++world) {
    AdjustedWorld adjusted{.report = std::move(progress.worlds[world].report)};
    std::vector<Digest>& blocks = model.blocks.emplace_back();
    for (BlockPlace& place : progress.blocks) {
      if (place.world != world) continue;
      ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
      blocks.push_back(place.block);
      adjusted.summaries.push_back(std::move(place.summary));
      ORBWEAVE_ASSIGN_OR_RETURN(adjusted.inspections.emplace_back(),
                                FetchBlob(place.inspection, blobs, DecodeBlockInspection));
    }
    model.worlds.push_back(ConcludeAdjustment(std::move(adjusted),
                                              divided.partition.seams,
                                              worlds[world].georeference,
                                              manifest,
                                              options.global));
    if (model.worlds.back().images.empty()) {  // nothing in it is placed by its own observations
      model.worlds.pop_back();
      model.blocks.pop_back();
    }
  }
  if (options.global.attach_loose) AttachLooseImages(manifest, model.worlds);
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeConcludedModel(model), blobs, result));
  result.report_json = nlohmann::json{{"worlds", model.worlds.size()}}.dump();
  return result;
}

}  // namespace orbweave
