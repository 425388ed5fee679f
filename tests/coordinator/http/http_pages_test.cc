// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/http/http_pages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/command.h"
#include "tests/support/failing_journal.h"
#include "tests/support/http_get.h"
#include "tests/support/manual_clock.h"
#include "tests/support/toy_job.h"

namespace orbweave {
namespace {

using testing::FailingJournal;
using ::testing::HasSubstr;
using testing::HttpGet;
using ::testing::Not;
using ::testing::StartsWith;
using testing::TemporaryFolder;

class HttpPagesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    CoordinatorOptions options{.state_dir = folder_.Path(), .find_plan = testing::FindToyPlan};
    options.open_journal = testing::OpenFailingJournal(fails_);
    auto opened = Coordinator::Open(options, clock_);
    ASSERT_TRUE(opened.ok()) << opened.status();
    coordinator_ = *std::move(opened);
    pages_ = std::make_unique<HttpPages>(
        *coordinator_, counters_, clock_, ProbePatience{.keep_s = 1.0, .wait_s = 3600.0});
  }

  HttpPage Find(const std::string& path) { return pages_->Find(path).value(); }
  void SubmitJob() {
    const auto job = testing::PrepareToyJob(*coordinator_, "1 2 3");
    ASSERT_TRUE(job.ok() && coordinator_->SubmitJob(*job).ok());
  }

  FailingJournal::Switch fails_;
  TemporaryFolder folder_;
  ManualClock clock_;
  MetricsCounters counters_;
  std::unique_ptr<Coordinator> coordinator_;
  std::unique_ptr<HttpPages> pages_;
};

TEST_F(HttpPagesTest, SaysThatACoordinatorIsAlive) {
  EXPECT_EQ(Find("/livez").status, 200);
  EXPECT_EQ(Find("/livez").body, "ok\n");
}

TEST_F(HttpPagesTest, SaysWhyACoordinatorIsNotReady) {
  EXPECT_EQ(Find("/readyz").status, 200);
  EXPECT_EQ(Find("/readyz").body, "ok\n");
  fails_.probes_fail = true;
  EXPECT_EQ(Find("/readyz").status, 200) << "it was asked just now";
  clock_.Advance(1.5);
  EXPECT_EQ(Find("/readyz").status, 503);
  EXPECT_EQ(Find("/readyz").body, "journal: disk full\n");
  EXPECT_EQ(Find("/livez").status, 200);
  fails_.probes_fail = false;
  clock_.Advance(1.5);
  EXPECT_EQ(Find("/readyz").status, 200);
}

TEST_F(HttpPagesTest, SaysHowManySlotsAreWanted) {
  EXPECT_EQ(Find("/wanted").body, "0\n");
  SubmitJob();
  EXPECT_EQ(Find("/wanted").body, "0\n") << "it was asked just now";
  clock_.Advance(1.5);
  EXPECT_EQ(Find("/wanted").body, "1\n");
}

TEST_F(HttpPagesTest, WritesMetricsAnewAfterAWhile) {
  const HttpPage before = Find("/metrics");
  EXPECT_EQ(before.status, 200);
  EXPECT_THAT(before.content_type, HasSubstr("version=0.0.4"));
  EXPECT_THAT(before.body, HasSubstr("orbweave_slots_wanted 0\n"));
  SubmitJob();
  EXPECT_EQ(Find("/metrics").body, before.body);
  clock_.Advance(1.5);
  EXPECT_THAT(Find("/metrics").body, HasSubstr("orbweave_slots_wanted 1\n"));
}

TEST_F(HttpPagesTest, KnowsNoOther) {
  for (const char* path : {"/", "/metricsz", "/livez/", "/ready", "", "/wanted.txt"}) {
    EXPECT_FALSE(pages_->Find(path).has_value()) << path;
  }
}

TEST_F(HttpPagesTest, TellsNothingThatStrangersWrote) {
  const auto job = testing::PrepareToyJob(*coordinator_, "1", "toy.x=a-secret");
  ASSERT_TRUE(job.ok() && coordinator_->SubmitJob(*job).ok());
  for (const char* path : {"/metrics", "/livez", "/readyz", "/wanted"}) {
    EXPECT_THAT(Find(path).body, Not(HasSubstr("squares"))) << path;
    EXPECT_THAT(Find(path).body, Not(HasSubstr("a-secret"))) << path;
  }
}

TEST_F(HttpPagesTest, AreServed) {
  const auto server = HttpServer::Start(
      "127.0.0.1:0", {}, [this](std::string_view path) { return pages_->Find(path); });
  ASSERT_TRUE(server.ok()) << server.status();
  for (const std::string path : {"/metrics", "/livez", "/readyz", "/wanted"}) {
    EXPECT_THAT(HttpGet((*server)->address(), path), StartsWith("HTTP/1.1 200 OK\r\n")) << path;
  }
  std::filesystem::remove(folder_ / "blobs/tmp");
  clock_.Advance(1.5);
  EXPECT_THAT(HttpGet((*server)->address(), "/readyz"), StartsWith("HTTP/1.1 503 "));
}

}  // namespace
}  // namespace orbweave
