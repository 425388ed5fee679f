// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traces/job_spans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const Digest kJob = DigestOf("job");
constexpr uint64_t kSince = 1ULL << 32;

LogEvent Begins(const std::string& event = "job_submitted", const std::string& traceparent = "") {
  return {.event = event,
          .job = kJob,
          .since_epoch = kSince,
          .traceparent = traceparent,
          .message = "street"};
}

LogEvent Ends(const std::string& event = "job_done") {
  return {.event = event, .job = kJob, .message = event == "job_failed" ? "why" : ""};
}

LogEvent Leased(uint64_t epoch, uint32_t run, uint32_t part, uint32_t slot = 0) {
  return {.event = "task_leased",
          .job = kJob,
          .stage = "stage" + std::to_string(run % 2),
          .run = run,
          .part = part,
          .task = DigestOf(std::to_string(part)),
          .worker = "w",
          .slot = slot,
          .epoch = kSince + epoch};
}

LogEvent Ended(uint64_t epoch, LogLevel level = LogLevel::kInfo, const std::string& why = "") {
  return {.level = level,
          .event = why.empty() ? "task_done" : "task_not_done",
          .job = kJob,
          .epoch = kSince + epoch,
          .message = why};
}

/// All spans of events that happen at 1, 2, 3 ...
std::vector<TraceSpan> SpansOf(JobSpans& spans, const std::vector<LogEvent>& events) {
  std::vector<TraceSpan> all;
  uint64_t now_ns = 0;
  for (const LogEvent& event : events) {
    for (TraceSpan& span : spans.Take(event, ++now_ns)) all.push_back(std::move(span));
  }
  return all;
}

std::vector<TraceSpan> SpansOf(const std::vector<LogEvent>& events) {
  JobSpans spans;
  return SpansOf(spans, events);
}

std::vector<std::string> NamesOf(const std::vector<TraceSpan>& spans) {
  std::vector<std::string> names;
  for (const TraceSpan& span : spans) names.push_back(span.name);
  return names;
}

TEST(JobSpans, AreATreeOfAJobItsStagesAndTheirAttempts) {
  const auto spans = SpansOf({Begins(),
                              Leased(1, 0, 0),
                              Ended(1),
                              Leased(2, 1, 0, 0),
                              Leased(3, 1, 1, 1),
                              Ended(3),
                              Ended(2),
                              Ends()});
  ASSERT_THAT(NamesOf(spans),
              ElementsAre("stage0 task", "stage0", "stage1 task", "stage1 task", "stage1", "job"));
  const TraceSpan& job = spans.back();
  EXPECT_EQ(job.parent_id, "");
  EXPECT_EQ(spans[1].parent_id, SpanIdText(job.id));
  EXPECT_EQ(spans[4].parent_id, SpanIdText(job.id));
  EXPECT_EQ(spans[0].parent_id, SpanIdText(spans[1].id));
  EXPECT_EQ(spans[2].parent_id, SpanIdText(spans[4].id));
  std::set<uint64_t> ids;
  for (const TraceSpan& span : spans) {
    EXPECT_EQ(span.trace_id, kJob.ToHex().substr(0, 32));
    EXPECT_LE(span.start_ns, span.end_ns);
    EXPECT_FALSE(span.error.has_value());
    ids.insert(span.id);
  }
  EXPECT_THAT(ids, SizeIs(spans.size()));
  EXPECT_EQ(job.start_ns, 1U);
  EXPECT_EQ(job.end_ns, 8U);
  EXPECT_EQ(spans[4].start_ns, 4U) << "its first lease";
  EXPECT_EQ(spans[4].end_ns, 7U) << "its last end";
  EXPECT_EQ(spans[4].numbers.at("orbweave.attempts"), 2U);
  EXPECT_EQ(job.texts.at("orbweave.label"), "street");
}

TEST(JobSpans, OfAnAttemptIsNamedByItsEpoch) {
  const auto spans = SpansOf({Begins(), Leased(1, 0, 3), Ended(1), Ends()});
  EXPECT_EQ(spans[0].id ^ spans.back().id, kSince + 1);
  EXPECT_EQ(spans[0].numbers.at("orbweave.epoch"), kSince + 1);
  EXPECT_EQ(spans[0].numbers.at("orbweave.part"), 3U);
}

TEST(JobSpans, BelongToTheSpanThatAskedForTheJob) {
  const std::string trace = "0af7651916cd43dd8448eb211c80319c";
  const auto spans = SpansOf({Begins("job_submitted", "00-" + trace + "-b7ad6b7169203331-01"),
                              Leased(1, 0, 0),
                              Ended(1),
                              Ends()});
  ASSERT_THAT(spans, SizeIs(3));
  for (const TraceSpan& span : spans) EXPECT_EQ(span.trace_id, trace);
  EXPECT_EQ(spans.back().parent_id, "b7ad6b7169203331");
}

TEST(JobSpans, AreNotMadeForATraceThatNobodyKeeps) {
  const std::string parent = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-00";
  EXPECT_THAT(SpansOf({Begins("job_submitted", parent), Leased(1, 0, 0), Ended(1), Ends()}),
              IsEmpty());
}

TEST(JobSpans, AreTheSameOfACoordinatorThatIsStartedAgain) {
  const std::vector<LogEvent> rest = {Leased(9, 4, 0), Ended(9), Ends()};
  std::vector<LogEvent> first = {Begins()};
  std::vector<LogEvent> again = {Begins("job_resumed")};
  first.insert(first.end(), rest.begin(), rest.end());
  again.insert(again.end(), rest.begin(), rest.end());
  const auto spans = SpansOf(first);
  const auto spans_again = SpansOf(again);
  ASSERT_EQ(spans.size(), spans_again.size());
  for (size_t i = 0; i < spans.size(); ++i) {
    EXPECT_EQ(spans[i].id, spans_again[i].id);
    EXPECT_EQ(spans[i].parent_id, spans_again[i].parent_id);
  }
}

TEST(JobSpans, OfAJobThatIsSubmittedAgainAreOthers) {
  JobSpans spans;
  const auto first = SpansOf(spans, {Begins(), Ends("job_failed")});
  LogEvent later = Begins();
  later.since_epoch = kSince + 7;
  const auto second = SpansOf(spans, {later, Ends()});
  EXPECT_NE(first.at(0).id, second.at(0).id);
  EXPECT_EQ(first.at(0).trace_id, second.at(0).trace_id);
  EXPECT_EQ(first.at(0).error, "why");
  EXPECT_FALSE(second.at(0).error.has_value());
}

TEST(JobSpans, SayWhyAnAttemptFailedAndWhichOnlyEnded) {
  const auto spans = SpansOf({Begins(),
                              Leased(1, 0, 0, 0),
                              Leased(2, 0, 1, 1),
                              Ended(1, LogLevel::kWarning, "out of memory"),
                              Ended(2, LogLevel::kInfo, "its worker left"),
                              Ends("job_cancelled")});
  ASSERT_THAT(spans, SizeIs(4));
  EXPECT_EQ(spans[0].error, "out of memory");
  EXPECT_FALSE(spans[1].error.has_value());
  EXPECT_EQ(spans[1].texts.at("orbweave.not_done"), "its worker left");
  EXPECT_EQ(spans[2].numbers.at("orbweave.attempts_failed"), 1U);
  EXPECT_FALSE(spans[3].error.has_value()) << "somebody wanted it cancelled";
}

TEST(JobSpans, OfALeaseThatWaitsBehindAnotherBeginsWhenTheSlotIsFree) {
  const auto spans =
      SpansOf({Begins(), Leased(1, 0, 0), Leased(2, 0, 1), Ended(1), Ended(2), Ends()});
  EXPECT_EQ(spans[0].start_ns, 2U);
  EXPECT_EQ(spans[0].end_ns, 4U);
  EXPECT_EQ(spans[1].start_ns, 4U);
  EXPECT_EQ(spans[1].end_ns, 5U);
}

TEST(JobSpans, OfAJobThatStartsOverHaveIdsOfTheirOwn) {
  const auto spans = SpansOf({Begins(),
                              Leased(1, 0, 0),
                              Ended(1),
                              Leased(2, 1, 0),
                              Ended(2, LogLevel::kWarning, "a blob is gone"),
                              Leased(3, 0, 0),
                              Ended(3),
                              Leased(4, 1, 0),
                              Ended(4),
                              Ends()});
  ASSERT_THAT(NamesOf(spans),
              ElementsAre("stage0 task",
                          "stage0",
                          "stage1 task",
                          "stage1",
                          "stage0 task",
                          "stage0",
                          "stage1 task",
                          "stage1",
                          "job"));
  std::set<uint64_t> ids;
  for (const TraceSpan& span : spans) ids.insert(span.id);
  EXPECT_THAT(ids, SizeIs(spans.size()));
}

TEST(JobSpans, LeaveOutWhatBeganBeforeTheCoordinatorDid) {
  EXPECT_THAT(SpansOf({Ended(1), Ends(), Leased(2, 0, 0), Ended(2)}), IsEmpty());
  LogEvent adopted = Leased(3, 0, 0);
  adopted.run.reset();
  EXPECT_THAT(NamesOf(SpansOf({Begins("job_resumed"), adopted, Ended(3), Ends()})),
              ElementsAre("job"));
}

}  // namespace
}  // namespace orbweave
