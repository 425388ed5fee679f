// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traces/span_sender.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "coordinator/traces/http_post.h"
#include "tests/support/command.h"
#include "tests/support/http_collector.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::HttpCollector;
using ::testing::StartsWith;
using testing::WaitUntil;

constexpr char kAway[] = "HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\n\r\n";
constexpr char kTaken[] = "HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\n{}";

HttpUrl UrlOf(const HttpCollector& collector) {
  return *ParseHttpUrl(collector.Url() + "/v1/traces");
}

TEST(HttpPost, SendsABodyAndReadsTheAnswer) {
  HttpCollector collector;
  collector.AnswerWith("HTTP/1.1 429 Slow down\r\nContent-Length: 4\r\n\r\nlate");
  const auto answer = HttpPost(UrlOf(collector), "application/json", "{\"a\":1}", 10.0);
  ASSERT_TRUE(answer.ok()) << answer.status();
  EXPECT_EQ(answer->status, 429);
  EXPECT_EQ(answer->body, "late");
  const std::string request = collector.Requests().at(0);
  EXPECT_THAT(request, StartsWith("POST /v1/traces HTTP/1.1\r\n"));
  EXPECT_THAT(request, HasSubstr("Host: 127.0.0.1:" + std::to_string(collector.port()) + "\r\n"));
  EXPECT_THAT(request, HasSubstr("Content-Type: application/json\r\n"));
  EXPECT_THAT(collector.Bodies(), ElementsAre("{\"a\":1}"));
}

TEST(HttpPost, SaysThatNobodyIsThere) {
  HttpUrl url;
  {
    const HttpCollector collector;
    url = UrlOf(collector);
  }
  EXPECT_TRUE(absl::IsUnavailable(HttpPost(url, "text/plain", "x", 10.0).status()));
  EXPECT_TRUE(absl::IsUnavailable(
      HttpPost({.host = "nobody.invalid", .port = "1"}, "text/plain", "x", 10.0).status()));
}

TEST(HttpPost, WaitsNoLongerThanItIsToldTo) {
  HttpCollector collector;
  collector.AnswerWith("");
  const auto answer = HttpPost(UrlOf(collector), "text/plain", "x", 0.2);
  EXPECT_TRUE(absl::IsUnavailable(answer.status()));
  EXPECT_THAT(std::string(answer.status().message()), HasSubstr("no answer for 0.2 s"));
}

TEST(HttpPost, TakesNoAnswerThatIsNoneOrTooLong) {
  HttpCollector collector;
  for (const std::string& wrong :
       {std::string("SSH-2.0-x\r\n\r\n"),
        std::string("HTTP/1.1 200 OK\r\nContent-Length: 5\r\n\r\nab"),
        "HTTP/1.1 200 OK\r\nContent-Length: 100000\r\n\r\n" + std::string(100'000, 'x'),
        "HTTP/1.1 200 OK\r\n\r\n" + std::string(100'000, 'x')}) {
    collector.AnswerWith(wrong);
    EXPECT_TRUE(absl::IsUnavailable(HttpPost(UrlOf(collector), "a/b", "x", 10.0).status()))
        << wrong.substr(0, 60);
  }
}

/// Counts what became of spans, and the events of the sender's own.
class SpanSenderTest : public ::testing::Test {
 protected:
  [[nodiscard]] SpanSenderOptions Options(const HttpUrl& collector) {
    return {.collector = collector,
            .linger_s = 0.01,
            .first_pause_s = 0.01,
            .longest_pause_s = 0.05,
            .count =
                [this](std::string_view outcome, uint64_t spans) {
                  const std::lock_guard lock(mutex_);
                  counts_[std::string(outcome)] += spans;
                },
            .log =
                [this](const LogEvent& event) {
                  const std::lock_guard lock(mutex_);
                  events_.push_back(event.event);
                }};
  }
  /// Tells of a job, which is one span.
  static void TellJob(SpanSender& sender, const std::string& name) {
    const Digest job = DigestOf(name);
    sender.Take({.event = "job_submitted", .job = job, .since_epoch = 1, .message = name});
    sender.Take({.event = "job_done", .job = job});
  }
  uint64_t CountOf(const std::string& outcome) {
    const std::lock_guard lock(mutex_);
    return counts_[outcome];
  }
  std::vector<std::string> Events() {
    const std::lock_guard lock(mutex_);
    return events_;
  }
  /// How many spans of jobs came, and of how many jobs.
  static std::pair<size_t, size_t> JobsIn(const std::vector<std::string>& bodies) {
    std::vector<std::string> ids;
    for (const std::string& body : bodies) {
      const auto request = nlohmann::json::parse(body);
      for (const auto& span : request.at("resourceSpans")[0].at("scopeSpans")[0].at("spans"))
        ids.push_back(span.at("spanId"));
    }
    std::ranges::sort(ids);
    const auto rest = std::ranges::unique(ids);
    return {ids.size(), ids.size() - rest.size()};
  }

  std::mutex mutex_;
  std::map<std::string, uint64_t> counts_;
  std::vector<std::string> events_;
};

TEST_F(SpanSenderTest, SendsWhatEndsAndTheRestWhenItEnds) {
  HttpCollector collector;
  {
    SpanSender sender(Options(UrlOf(collector)));
    TellJob(sender, "first");
    EXPECT_TRUE(WaitUntil([&] { return CountOf("sent") == 1; }, 60.0));
    for (int i = 0; i < 2000; ++i) TellJob(sender, std::to_string(i));
  }
  EXPECT_EQ(CountOf("sent"), 2001U);
  EXPECT_EQ(CountOf("dropped") + CountOf("refused"), 0U);
  EXPECT_EQ(JobsIn(collector.Bodies()), std::make_pair(size_t{2001}, size_t{2001}));
  EXPECT_TRUE(Events().empty());
}

TEST_F(SpanSenderTest, KeepsWhatItHasRoomForWhileTheCollectorIsAwayAndDropsTheRest) {
  HttpCollector collector;
  collector.AnswerWith(kAway);
  SpanSenderOptions options = Options(UrlOf(collector));
  options.most_spans = 10;
  SpanSender sender(options);
  for (int i = 0; i < 25; ++i) TellJob(sender, std::to_string(i));
  EXPECT_EQ(CountOf("dropped"), 15U);
  EXPECT_TRUE(WaitUntil([&] { return collector.Requests().size() >= 3; }, 60.0))
      << "it tries again";
  EXPECT_THAT(Events(), ElementsAre("collector_away"));
  collector.AnswerWith(kTaken);
  EXPECT_TRUE(WaitUntil([&] { return CountOf("sent") == 10; }, 60.0));
  EXPECT_THAT(Events(), ElementsAre("collector_away", "collector_back"));
  TellJob(sender, "later");
  EXPECT_TRUE(WaitUntil([&] { return CountOf("sent") == 11; }, 60.0)) << "there is room again";
}

TEST_F(SpanSenderTest, NeverHoldsUpWhoTellsIt) {
  HttpCollector collector;
  collector.AnswerWith("");
  SpanSenderOptions options = Options(UrlOf(collector));
  options.timeout_s = 1.0;
  options.most_spans = 100;
  {
    SpanSender sender(options);
    TellJob(sender, "first");
    ASSERT_TRUE(WaitUntil([&] { return !collector.Requests().empty(); }, 60.0));
    for (int i = 0; i < 1000; ++i) TellJob(sender, std::to_string(i));
    EXPECT_EQ(CountOf("dropped"), 901U) << "all were told while the first waits for its answer";
  }
  EXPECT_EQ(CountOf("dropped"), 1001U) << "nobody took them in the end";
  EXPECT_EQ(CountOf("sent"), 0U);
}

TEST_F(SpanSenderTest, CountsWhatTheCollectorRefuses) {
  HttpCollector collector;
  const std::string partial = R"({"partialSuccess":{"rejectedSpans":"1"}})";
  collector.AnswerWith("HTTP/1.1 200 OK\r\nContent-Length: " + std::to_string(partial.size()) +
                       "\r\n\r\n" + partial);
  SpanSender sender(Options(UrlOf(collector)));
  TellJob(sender, "partly");
  EXPECT_TRUE(WaitUntil([&] { return CountOf("refused") == 1; }, 60.0));
  collector.AnswerWith("HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n");
  TellJob(sender, "nowhere");
  EXPECT_TRUE(WaitUntil([&] { return CountOf("refused") == 2; }, 60.0));
  EXPECT_EQ(CountOf("sent"), 0U);
  EXPECT_THAT(Events(), ElementsAre("spans_refused")) << "said once";
}

}  // namespace
}  // namespace orbweave
