// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/artifacts/check_adjustment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using Work = LmRequest::Work;

constexpr SeparatorId kPose{SeparatorId::Kind::kPose, 1};
constexpr SeparatorId kPoint{SeparatorId::Kind::kPoint, 7};

void ExpectDamaged(const absl::Status& status, const std::string& words) {
  EXPECT_TRUE(absl::IsDataLoss(status)) << status;
  EXPECT_THAT(status.message(), HasSubstr(words));
}

/// Image 0 and, shared with another, image 1; image 2 without a place. A track of its own, one
/// split.
Subproblem Block() {
  Subproblem subproblem;
  for (uint32_t i = 0; i < 3; ++i) {
    subproblem.scene.images[ImageId(i)] = {.loose = i == 2};
    subproblem.images.push_back({.id = ImageId(i), .is_separator = i > 0});
  }
  const Track track{.observations = {{{ImageId(0), 0}}, {{ImageId(1), 0}}}};
  subproblem.scene.tracks = {track};
  subproblem.split = {{.id = kPoint.index, .part = track}};
  return subproblem;
}

EvaluatedState StateOf() {
  EvaluatedState state;
  state.variables.poses.resize(2);
  state.variables.points.resize(2);
  state.costs.per_point.resize(1);
  state.retained_points_before.resize(1);
  return state;
}

TEST(CheckState, RefusesThatOfAnotherBlock) {
  EXPECT_TRUE(CheckState(Block(), StateOf()).ok());
  EXPECT_TRUE(CheckState({}, {}).ok());
  for (const auto spoil : {+[](EvaluatedState& s) { s.variables.poses.pop_back(); },
                           +[](EvaluatedState& s) { s.variables.points.pop_back(); },
                           +[](EvaluatedState& s) { s.variables.biases.emplace_back(); },
                           +[](EvaluatedState& s) { s.costs.per_point.pop_back(); },
                           +[](EvaluatedState& s) { s.retained_points_before.clear(); }}) {
    EvaluatedState state = StateOf();
    spoil(state);
    ExpectDamaged(CheckState(Block(), state), "a state is of another block");
  }
}

TEST(CheckRequest, RefusesStepsOfOtherVariables) {
  LmRequest request{
      .work = Work::kTrial,
      .step = {.variables = {kPose, kPoint}, .steps = {Vector6::Zero(), Vector6::Zero()}}};
  EXPECT_TRUE(CheckRequest(Block(), request, true).ok());
  request.step.variables = {kPoint};
  ExpectDamaged(CheckRequest(Block(), request, true), "other variables");
  request.step.variables = {{SeparatorId::Kind::kPose, 2}, kPoint};
  ExpectDamaged(CheckRequest(Block(), request, true), "other variables");
}

TEST(CheckRequest, RefusesToGoOnFromNoState) {
  EXPECT_TRUE(CheckRequest(Block(), {.work = Work::kEvaluate}, false).ok());
  for (const Work work : {Work::kLinearise, Work::kTrial, Work::kFilter})
    ExpectDamaged(CheckRequest(Block(), {.work = work}, false), "no state");
}

/// A world of one block that was asked for `work`.
WorldProgress Asked(Work work) {
  WorldProgress world{.asked = work};
  world.path.separators_of_subproblem = {{kPose, kPoint}};
  world.report.adjustments.emplace_back();
  world.report.accepted_costs = {{1.0}};
  return world;
}

std::vector<SubproblemResult> Replied() {
  SubproblemResult result;
  result.reply.separators = {kPose, kPoint};
  result.reply.system.variables = {kPose, kPoint};
  result.reply.trial.retained_points.resize(1);
  return {result};
}

TEST(CheckReplies, TakesRepliesToWhatWasAsked) {
  for (const Work work : {Work::kEvaluate, Work::kLinearise, Work::kTrial, Work::kFilter})
    EXPECT_TRUE(CheckReplies(Asked(work), Replied(), {}).ok());
  std::vector<SubproblemResult> failed = Replied();
  failed[0].reply.system = {.is_definite = false};
  EXPECT_TRUE(CheckReplies(Asked(Work::kLinearise), failed, {}).ok());
}

TEST(CheckReplies, RefusesRepliesOfOtherVariables) {
  std::vector<SubproblemResult> replies = Replied();
  replies[0].reply.system.variables = {kPose};
  ExpectDamaged(CheckReplies(Asked(Work::kEvaluate), replies, {}), "other variables");
  ExpectDamaged(CheckReplies(Asked(Work::kLinearise), replies, {}), "other variables");
  replies[0].reply.trial.retained_points.clear();
  ExpectDamaged(CheckReplies(Asked(Work::kTrial), replies, {}), "other points");
  ExpectDamaged(CheckReplies(Asked(Work::kEvaluate), {}, {}), "without blocks");
}

TEST(CheckReplies, RefusesAWorldThatWouldNeverEnd) {
  WorldProgress world = Asked(Work::kLinearise);
  world.phase = 4;  // of 3
  ExpectDamaged(CheckReplies(world, Replied(), {.rounds = 2}), "phase 4 of 3");
  world.phase = 3;
  ExpectDamaged(CheckReplies(world, Replied(), {.rounds = 2}), "phase 3 of 3");
  world.is_done = true;
  ExpectDamaged(CheckReplies(world, Replied(), {.rounds = 2}), "phase 3 of 3");
  world.asked = Work::kFilter;
  EXPECT_TRUE(CheckReplies(world, Replied(), {.rounds = 2}).ok());
  world = Asked(Work::kTrial);
  world.report.accepted_costs.clear();
  ExpectDamaged(CheckReplies(world, Replied(), {}), "before the first");
  world = Asked(Work::kTrial);
  world.path.separators_of_subproblem.clear();
  ExpectDamaged(CheckReplies(world, Replied(), {}), "other blocks");
}

TEST(CheckFinished, RefusesAnAdjustmentOfOtherWorlds) {
  std::vector<JoinedWorld> worlds = {{.num_subproblems = 1}};
  AdjustmentProgress progress{.worlds = {{}}, .is_asked = {0}, .subproblems = {{.world = 0}}};
  EXPECT_TRUE(CheckFinished(progress, worlds).ok());
  ExpectDamaged(CheckFinished(progress, {}), "1 worlds of 0");
  worlds[0].georeference.enu_from_world = Sim3{};
  ExpectDamaged(CheckFinished(progress, worlds), "never adjusted");
  progress.worlds[0].report.adjustments.emplace_back();
  EXPECT_TRUE(CheckFinished(progress, worlds).ok());
  progress.is_asked[0] = 1;
  ExpectDamaged(CheckFinished(progress, worlds), "not adjusted yet");
  progress.subproblems.clear();
  ExpectDamaged(CheckFinished(progress, worlds), "other blocks");
}

/// Image 0 of drive 4, image 1 of drive 9, both placed; image 2 loose.
ImageManifest TwoDrives() {
  ImageManifest manifest;
  for (uint32_t i = 0; i < 3; ++i) {
    manifest.images.push_back({.id = ImageId(i), .drive = i == 0 ? 4U : 9U});
    manifest.images.back().prior.position_in_enu = Eigen::Vector3d::Zero();
  }
  return manifest;
}

AdjustedWorld World() {
  AdjustedWorld world;
  world.summaries.emplace_back();
  world.summaries[0].owned_images = {
      {ImageId(0), {}}, {ImageId(1), {}}, {ImageId(2), {.loose = true}}};
  world.summaries[0].biases = {{.group = 0}, {.group = 1}};
  world.inspections.emplace_back();
  world.inspections[0].bearings.variables = {kPose, kPoint};
  world.inspections[0].held = ImageId(0);
  return world;
}

TEST(CheckAdjustedWorld, RefusesWhatIsOfNoImageOfTheWorld) {
  const Georeference on_earth{.enu_from_world = Sim3{}};
  EXPECT_TRUE(CheckAdjustedWorld(World(), on_earth, TwoDrives()).ok());
  ImageManifest smaller = TwoDrives();
  smaller.images.pop_back();
  ExpectDamaged(CheckAdjustedWorld(World(), on_earth, smaller), "a block has image 2 of 2");
  for (const uint32_t image : {2U, 3U, 4000000000U}) {
    AdjustedWorld world = World();
    world.inspections[0].bearings.variables = {{SeparatorId::Kind::kPose, image}};
    ExpectDamaged(CheckAdjustedWorld(world, on_earth, TwoDrives()), "no block has placed");
    world = World();
    world.inspections[0].held = ImageId(image);
    ExpectDamaged(CheckAdjustedWorld(world, on_earth, TwoDrives()), "no block has placed");
    world = World();
    world.inspections[0].farthest = ImageId(image);
    ExpectDamaged(CheckAdjustedWorld(world, on_earth, TwoDrives()), "no block has placed");
  }
}

TEST(CheckAdjustedWorld, RefusesABiasOfNoDriveOfTheWorld) {
  const Georeference on_earth{.enu_from_world = Sim3{}};
  AdjustedWorld world = World();
  world.summaries[0].biases[1].group = 2;
  ExpectDamaged(CheckAdjustedWorld(world, on_earth, TwoDrives()), "drive 2 of 2");
  ExpectDamaged(CheckAdjustedWorld(World(), {}, TwoDrives()), "drive 0 of 0");
  ImageManifest one_drive = TwoDrives();
  for (ImageRecord& image : one_drive.images) image.drive = 4;
  ExpectDamaged(CheckAdjustedWorld(World(), on_earth, one_drive), "drive 0 of 0");
}

}  // namespace
}  // namespace orbweave
