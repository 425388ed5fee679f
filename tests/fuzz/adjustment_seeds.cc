// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/adjustment_codec.h"
#include "proto/codec/inspection_codec.h"
#include "proto/codec/subproblem_codec.h"
#include "tests/fuzz/artifact_values.h"
#include "tests/fuzz/seeds.h"

namespace orbweave {
namespace {

Subproblem SmallSubproblem() {
  Subproblem subproblem{.cluster = 3, .scene = TwoViewsOfAPoint()};
  subproblem.scene.images[ImageId(2)].loose = false;
  subproblem.directions = {{.image = ImageId(2), .sigma_rad = 0.1}};
  subproblem.images = {{.id = ImageId(0), .camera = {64, 32}, .owner = 3, .is_held = true},
                       {.id = ImageId(2), .camera = {64, 32}, .is_separator = true}};
  subproblem.split = {{.id = 5, .part = subproblem.scene.tracks[0]}};
  subproblem.priors = {{.image = ImageId(0), .bias_group = 1}, {.image = ImageId(2)}};
  subproblem.biases = {{.group = 1, .is_separator = true, .sigma_m = 2.0}};
  subproblem.farthest = ImageId(2);
  return subproblem;
}

/// Two variables that share a block.
SeparatorSystem SmallSystem() {
  SymmetricBlockMatrix S{.num_blocks = 2, .column_start = {0, 1, 3}, .rows = {0, 0, 1}};
  S.values.assign(3, Block6::Identity());
  return {.variables = {{SeparatorId::Kind::kPose, 2}, {SeparatorId::Kind::kPoint, 5}},
          .normal = MakeNormalSystem(std::move(S))};
}

SubproblemSummary SmallSummary() {
  SubproblemSummary summary{.cluster = 3,
                            .owned_images = TwoViewsOfAPoint().images,
                            .observations_of_image = {{ImageId(0), 1}, {ImageId(2), 1}},
                            .biases = SmallSubproblem().biases};
  summary.pattern.count[0] = 1;
  return summary;
}

GlobalAdjustReport SmallReport() {
  GlobalAdjustReport report{.accepted_costs = {{2.0, 1.0}}, .bytes_of_subproblem = {100}};
  report.gnss = {.used = true, .reason = "r", .outliers = {"a.jpg"}};
  report.uncertainty = {.known = true, .held_image = "b.jpg"};
  report.adjustments.push_back({.iterations = 3, .converged = true, .biases_m = {{1, 2, 3}}});
  report.weak_images = {{"d.jpg", "its 8 observations lie in one corner"}};
  report.checks = {{"gnss_clock", 0.8, 0.2, "s", CheckLevel::kDoubtful, "the clock is late"}};
  return report;
}

}  // namespace

void AddAdjustmentSeeds(Seeds& seeds) {
  const Digest digest = DigestOf("blob");
  const Subproblem subproblem = SmallSubproblem();
  seeds["world_block"] = {EncodeSubproblem(subproblem).value(), EncodeSubproblem({}).value()};
  seeds["assemble_recipe"] = {
      EncodeAssembleRecipe({.joined = {.subproblem = subproblem, .submodels = {{.submodel = 1}}},
                            .cluster_result = digest,
                            .shared = {ImageId(2)}})
          .value()};
  seeds["joined_worlds"] = {
      EncodeJoinedWorlds(
          {{.georeference = {.enu_from_world = Sim3{},
                             .reason = "r",
                             .drive_errors = {{.drive = 3, .ahead = -0.8, .ahead_sigma = 0.1}},
                             .checks = SmallReport().checks},
            .num_images = 2},
           {.num_subproblems = 1}})
          .value()};
  EvaluatedState state;
  state.variables.poses = {{}, {}};
  state.variables.points = {{1, 2, 3}};
  state.variables.biases = {{0, 0, 1}};
  state.costs.per_point = {0.5};
  state.retained_points_before = {{1, 2, 2}};
  seeds["block_state"] = {EncodeSubproblemState(state).value()};
  SubproblemTask task{.subproblem = digest, .state = digest};
  task.request.shortened = {{5, 0.25}};
  task.request.step = {.variables = {{SeparatorId::Kind::kPose, 2}}, .steps = {Vector6::Ones()}};
  seeds["block_task"] = {EncodeSubproblemTask(task).value()};
  SubproblemResult result{.subproblem = digest, .state = digest, .inspection = digest};
  result.reply.separators = SmallSystem().variables;
  result.reply.system = SmallSystem();
  result.reply.trial.retained_points = {{.cost_before = 1.0}};
  result.reply.summary = SmallSummary();
  seeds["block_result"] = {EncodeSubproblemResult(result).value()};
  seeds["block_inspection"] = {
      EncodeSubproblemInspection(
          {.bearings = SmallSystem(),
           .sum_of_squares = 8.0,
           .redundancy = 9.0,
           .held = ImageId(0),
           .placements = {{.image = ImageId(2), .cluster = 3, .num_points = 7}},
           .supports = {{.image = ImageId(2), .patch = 5, .observations = 8, .equations = 16}},
           .points_about = {{1, 2, 3}},
           .seen_between = {{.image = ImageId(2), .asked = 60, .seen = 20}}})
          .value()};
  AdjustmentProgress progress{.worlds = {{.phase = 1, .report = SmallReport()}}, .is_asked = {1}};
  progress.worlds[0].path.separators_of_subproblem = {SmallSystem().variables};
  progress.subproblems = {
      {.subproblem = digest, .state = digest, .summary = SmallSummary(), .inspection = digest}};
  seeds["adjustment_progress"] = {EncodeAdjustmentProgress(progress).value()};
  FinalisedModel model{.worlds = {{.images = TwoViewsOfAPoint().images, .report = SmallReport()}},
                       .subproblems = {{digest}}};
  model.worlds[0].seams = {{.cluster_a = 1, .cluster_b = 3, .num_images = 2}};
  seeds["concluded_model"] = {EncodeFinalisedModel(model).value()};
}

}  // namespace orbweave
