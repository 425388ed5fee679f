// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/adjustment_codec.h"
#include "proto/codec/block_codec.h"
#include "proto/codec/inspection_codec.h"
#include "tests/fuzz/artifact_values.h"
#include "tests/fuzz/seeds.h"

namespace orbweave {
namespace {

WorldBlock SmallBlock() {
  WorldBlock block{.cluster = 3, .scene = TwoViewsOfAPoint()};
  block.directions = {{.image = ImageId(2), .sigma_rad = 0.1}};
  block.images = {{.id = ImageId(0), .camera = {64, 32}, .owner = 3, .is_held = true},
                  {.id = ImageId(2), .camera = {64, 32}, .is_separator = true}};
  block.split = {{.id = 5, .part = block.scene.tracks[0]}};
  block.priors = {{.image = ImageId(0), .bias_group = 1}, {.image = ImageId(2)}};
  block.biases = {{.group = 1, .is_separator = true, .sigma_m = 2.0}};
  block.farthest = ImageId(2);
  return block;
}

/// Two variables that share a block.
SeparatorSystem SmallSystem() {
  SymmetricBlockMatrix S{.num_blocks = 2, .column_start = {0, 1, 3}, .rows = {0, 0, 1}};
  S.values.assign(3, Block6::Identity());
  return {.variables = {{SeparatorId::Kind::kPose, 2}, {SeparatorId::Kind::kPoint, 5}},
          .normal = MakeNormalSystem(std::move(S))};
}

BlockSummary SmallSummary() {
  BlockSummary summary{.cluster = 3,
                       .owned_images = TwoViewsOfAPoint().images,
                       .observations_of_image = {{ImageId(0), 1}, {ImageId(2), 1}},
                       .biases = SmallBlock().biases};
  summary.pattern.count[0] = 1;
  return summary;
}

GlobalAdjustReport SmallReport() {
  GlobalAdjustReport report{.accepted_costs = {{2.0, 1.0}}, .bytes_of_block = {100}};
  report.gnss = {.used = true, .reason = "r", .outliers = {"a.jpg"}};
  report.uncertainty = {.known = true, .held_image = "b.jpg"};
  report.adjustments.push_back({.iterations = 3, .converged = true, .biases_m = {{1, 2, 3}}});
  report.unobserved_images = {"c.jpg"};
  report.weak_images = {{"d.jpg", "its 8 observations lie in one corner"}};
  report.checks = {{"gnss_clock", 0.8, 0.2, "s", CheckLevel::kDoubtful, "the clock is late"}};
  return report;
}

}  // namespace

void AddAdjustmentSeeds(Seeds& seeds) {
  const Digest digest = DigestOf("blob");
  const WorldBlock block = SmallBlock();
  seeds["world_block"] = {EncodeWorldBlock(block), EncodeWorldBlock({})};
  seeds["assemble_recipe"] = {
      EncodeAssembleRecipe({.joined = {.block = block, .components = {{.component = 1}}},
                            .cluster_result = digest,
                            .shared = {ImageId(2)}})};
  seeds["joined_worlds"] = {EncodeJoinedWorlds(
      {{.georeference = {.enu_from_world = Sim3{},
                         .reason = "r",
                         .drive_errors = {{.drive = 3, .ahead = -0.8, .ahead_sigma = 0.1}},
                         .checks = SmallReport().checks},
        .num_images = 2},
       {.num_blocks = 1}})};
  EvaluatedState state;
  state.variables.poses = {{}, {}};
  state.variables.points = {{1, 2, 3}};
  state.variables.biases = {{0, 0, 1}};
  state.costs.per_point = {0.5};
  state.kept_points_before = {{1, 2, 2}};
  seeds["block_state"] = {EncodeBlockState(state)};
  BlockTask task{.block = digest, .state = digest};
  task.order.shortened = {{5, 0.25}};
  task.order.step = {.variables = {{SeparatorId::Kind::kPose, 2}}, .steps = {Vector6::Ones()}};
  seeds["block_task"] = {EncodeBlockTask(task)};
  BlockResult result{.block = digest, .state = digest, .inspection = digest};
  result.answer.separators = SmallSystem().variables;
  result.answer.system = SmallSystem();
  result.answer.trial.kept_points = {{.cost_before = 1.0}};
  result.answer.summary = SmallSummary();
  seeds["block_result"] = {EncodeBlockResult(result)};
  seeds["block_inspection"] = {EncodeBlockInspection(
      {.bearings = SmallSystem(),
       .sum_of_squares = 8.0,
       .redundancy = 9.0,
       .held = ImageId(0),
       .placements = {{.image = ImageId(2), .cluster = 3, .num_points = 7}},
       .supports = {{.image = ImageId(2), .patch = 5, .observations = 8, .equations = 16}},
       .points_about = {{1, 2, 3}}})};
  AdjustmentProgress progress{.worlds = {{.phase = 1, .report = SmallReport()}}, .is_asked = {1}};
  progress.worlds[0].path.separators_of_block = {SmallSystem().variables};
  progress.blocks = {
      {.block = digest, .state = digest, .summary = SmallSummary(), .inspection = digest}};
  seeds["adjustment_progress"] = {EncodeAdjustmentProgress(progress)};
  ConcludedModel model{.worlds = {{.images = TwoViewsOfAPoint().images, .report = SmallReport()}},
                       .blocks = {{digest}}};
  model.worlds[0].seams = {{.cluster_a = 1, .cluster_b = 3, .num_images = 2}};
  seeds["concluded_model"] = {EncodeConcludedModel(model)};
}

}  // namespace orbweave
