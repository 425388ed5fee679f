// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/coordinator_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace orbweave {
namespace {

TEST(CoordinatorCodec, JobStatusSurvivesTheRoundTrip) {
  const JobStatus status{.id = DigestOf("job"),
                         .state = JobState::kFailed,
                         .error = "why",
                         .unmet = "1 GPU",
                         .spec = {.kind = "sparse",
                                  .inputs = {DigestOf("a")},
                                  .options_text = "x.y=1\n",
                                  .label = "street",
                                  .traceparent = "00-trace"},
                         .elapsed_s = 1.5,
                         .stages = {{"align", 9, 8, 7, 1, 2, 3.5, 4.5, 0.25}}};
  const auto back = FromProto(ToProto(status));
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->id, status.id);
  EXPECT_EQ(back->state, status.state);
  EXPECT_EQ(back->error, status.error);
  EXPECT_EQ(back->unmet, status.unmet);
  EXPECT_EQ(back->spec.Id(), status.spec.Id());
  EXPECT_EQ(back->spec.label, "street");
  EXPECT_EQ(back->spec.traceparent, "00-trace");
  EXPECT_EQ(back->elapsed_s, 1.5);
  const StageStatus& stage = back->stages.at(0);
  EXPECT_EQ(stage.stage, "align");
  EXPECT_EQ(stage.tasks_total, 9U);
  EXPECT_EQ(stage.tasks_done, 8U);
  EXPECT_EQ(stage.tasks_reused, 7U);
  EXPECT_EQ(stage.tasks_running, 1U);
  EXPECT_EQ(stage.retries, 2U);
  EXPECT_EQ(stage.wall_s, 3.5);
  EXPECT_EQ(stage.cpu_s, 4.5);
  EXPECT_EQ(stage.fraction_running, 0.25);
}

TEST(CoordinatorCodec, WorkerStatusSurvivesTheRoundTrip) {
  const WorkerStatus worker = FromProto(ToProto(WorkerStatus{"w", 2, 3, false, true, true, 1}));
  EXPECT_EQ(worker.name, "w");
  EXPECT_EQ(worker.slots, 2U);
  EXPECT_EQ(worker.tasks_done, 3U);
  EXPECT_FALSE(worker.alive);
  EXPECT_TRUE(worker.set_aside);
  EXPECT_EQ(worker.tasks_running, 1U);
  EXPECT_TRUE(worker.draining);
}

TEST(CoordinatorCodec, CostsAndTimingsSurviveTheRoundTrip) {
  const TaskCost cost{1.5, 2.5, 1ULL << 40, 7, 1ULL << 33};
  const auto result = FromProto(ToProto(TaskResult{.report_json = "{}", .cost = cost}));
  ASSERT_TRUE(result.ok());
  const MeasuredTask task = FromProto(ToProto(MeasuredTask{3, "align", 4, cost}));
  EXPECT_EQ(task.run, 3U);
  EXPECT_EQ(task.stage, "align");
  EXPECT_EQ(task.part, 4U);
  for (const TaskCost& back : {result->cost, task.cost}) {
    EXPECT_EQ(back.wall_s, 1.5);
    EXPECT_EQ(back.cpu_s, 2.5);
    EXPECT_EQ(back.bytes_in, 1ULL << 40);
    EXPECT_EQ(back.bytes_out, 7U);
    EXPECT_EQ(back.peak_memory_bytes, 1ULL << 33);
  }
  const TaskTiming timing = FromProto(ToProto(TaskTiming{2, "align", 4, "w", 1, 0.5, 0.75, false}));
  EXPECT_EQ(timing.run, 2U);
  EXPECT_EQ(timing.part, 4U);
  EXPECT_EQ(timing.slot, 1U);
  EXPECT_EQ(timing.end_s, 0.75);
  EXPECT_FALSE(timing.ok);
}

TEST(CoordinatorCodec, WhatAWorkerOffersSurvivesTheRoundTrip) {
  const WorkerOffers offers{.memory_bytes = 1ULL << 36, .threads = 12, .gpus = 2};
  EXPECT_EQ(FromProto(ToProto(WorkerInfo{.name = "w", .offers = offers}))->offers, offers);
  v1::JoinRequest older;  // knows nothing of offers
  older.set_name("w");
  EXPECT_EQ(FromProto(older)->offers, WorkerOffers{});
}

TEST(CoordinatorCodec, LeaseSurvivesTheRoundTrip) {
  const Lease lease{
      DigestOf("t"), 1ULL << 33, {"stage", "5", {DigestOf("a"), DigestOf("b")}, "o.p=1\n", 4}, 3};
  const auto back = FromProto(ToProto(lease));
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->task, lease.task);
  EXPECT_EQ(back->epoch, lease.epoch);
  EXPECT_EQ(back->slot, 3U);
  EXPECT_EQ(back->spec.Id(), lease.spec.Id());
  EXPECT_EQ(back->spec.part, 4U);
}

TEST(CoordinatorCodec, RefusesADigestOfAnotherLength) {
  v1::Lease lease = ToProto(Lease{DigestOf("t"), 1, {"stage", "5", {DigestOf("a")}, "", 0}, 0});
  lease.mutable_spec()->set_inputs(0, "short");
  EXPECT_TRUE(absl::IsInvalidArgument(FromProto(lease).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(DigestFromProto("").status()));
}

TEST(CoordinatorCodec, RefusesATaskThatTookNoTime) {
  for (const double seconds : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300}) {
    TaskResult result{.cost = {.wall_s = seconds, .cpu_s = 1.0}};
    EXPECT_TRUE(absl::IsInvalidArgument(FromProto(ToProto(result)).status())) << seconds;
    std::swap(result.cost.wall_s, result.cost.cpu_s);
    EXPECT_TRUE(absl::IsInvalidArgument(FromProto(ToProto(result)).status())) << seconds;
  }
}

TEST(CoordinatorCodec, RefusesAnUnknownJobState) {
  EXPECT_TRUE(JobStateFromProto(3).ok());
  EXPECT_TRUE(absl::IsInvalidArgument(JobStateFromProto(4).status()));
}

}  // namespace
}  // namespace orbweave
