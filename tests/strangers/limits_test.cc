// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What one caller may ask for at most.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <stop_token>
#include <thread>
#include <vector>

#include "orbweave/v1/coordinator.grpc.pb.h"
#include "tests/support/tcp_talk.h"
#include "tests/support/tls_server.h"
#include "worker/grpc_channel.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using testing::PrepareToyJob;
using testing::TlsServer;
using testing::Worker;

TEST(Limits, AMessageHasItsSize) {
  TlsServer server({.limits = {.message_bytes = 100'000}});
  const auto client = server.As("client");
  JobSpec large = *PrepareToyJob(*client, "1");
  large.label = std::string(100'001, 'x');
  EXPECT_TRUE(absl::IsResourceExhausted(client->SubmitJob(large).status()));
  large.label.resize(1000);
  EXPECT_TRUE(client->SubmitJob(large).ok());
}

TEST(Limits, AChunkOfABlobIsAMessageToo) {
  TlsServer server;
  const auto stub =
      v1::Coordinator::NewStub(OpenChannel(server.address(), server.keys() + "/client"));
  grpc::ClientContext context;
  v1::PutBlobReply reply;
  const auto writer = stub->PutBlob(&context, &reply);
  v1::BlobChunk chunk;
  chunk.set_data(std::string((8 << 20) + 1, 'x'));
  writer->Write(chunk);
  writer->WritesDone();
  EXPECT_EQ(writer->Finish().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
}

TEST(Limits, ABlobHasItsSizeAndItsName) {
  TlsServer server;
  const auto stub =
      v1::Coordinator::NewStub(OpenChannel(server.address(), server.keys() + "/client"));
  const auto put = [&stub](const v1::BlobChunk& chunk) {
    grpc::ClientContext context;
    v1::PutBlobReply reply;
    const auto writer = stub->PutBlob(&context, &reply);
    writer->Write(chunk);
    writer->WritesDone();
    return writer->Finish().error_code();
  };
  v1::BlobChunk chunk;
  chunk.set_data("bytes");
  EXPECT_EQ(put(chunk), grpc::StatusCode::INVALID_ARGUMENT) << "it has no name";
  chunk.set_digest(std::string(32, 'd'));
  EXPECT_EQ(put(chunk), grpc::StatusCode::DATA_LOSS) << "more bytes than were said";
  chunk.set_size_bytes((uint64_t{8} << 30) + 1);
  EXPECT_EQ(put(chunk), grpc::StatusCode::INVALID_ARGUMENT) << "more than a blob may have";
}

TEST(Limits, RunningJobsAreCounted) {
  TlsServer server({}, {.max_running_jobs = 2});
  const auto client = server.As("client");
  const auto submit = [&client](const std::string& numbers) {
    return client->SubmitJob(*PrepareToyJob(*client, numbers));
  };
  const auto first = submit("1");
  ASSERT_TRUE(first.ok());
  ASSERT_TRUE(submit("2").ok());
  const absl::Status third = submit("3").status();
  EXPECT_TRUE(absl::IsResourceExhausted(third));
  EXPECT_THAT(std::string(third.message()), HasSubstr("2 jobs are running"));
  EXPECT_TRUE(submit("2").ok()) << "joins the one that runs";
  ASSERT_TRUE(client->CancelJob(*first).ok());
  EXPECT_TRUE(submit("3").ok());
}

/// A worker with slots.
WorkerInfo WideWorker(uint32_t slots) {
  WorkerInfo worker = Worker("node");
  worker.slots = slots;
  return worker;
}

TEST(Limits, WhoWaitsForATaskTakesNoThread) {
  constexpr uint32_t kThreads = 12;
  TlsServer server({.limits = {.threads = kThreads}});
  const auto node = server.As("node");
  const uint64_t session = node->Join(WideWorker(4 * kThreads))->session;
  std::stop_source leave;
  std::atomic<uint32_t> left{0};
  {
    std::vector<std::jthread> waiting;
    for (uint32_t slot = 0; slot < 4 * kThreads; ++slot) {
      waiting.emplace_back([&, slot] {
        if (absl::IsCancelled(node->LeaseTask(session, slot, 60.0, leave.get_token()).status()))
          ++left;
      });
    }
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(node->Heartbeat(session, {}).ok());
    leave.request_stop();
  }
  EXPECT_EQ(left, 4 * kThreads) << "none was turned away";
}

TEST(Limits, CallsBeyondTheThreadsAreTurnedAway) {
  constexpr size_t kThreads = 12;
  TlsServer server({.limits = {.threads = kThreads}});
  const auto stub =
      v1::Coordinator::NewStub(OpenChannel(server.address(), server.keys() + "/client"));
  struct Upload {
    grpc::ClientContext context{};
    v1::PutBlobReply reply{};
    std::unique_ptr<grpc::ClientWriter<v1::BlobChunk>> writer{};
  };
  std::vector<Upload> uploads(2 * kThreads);
  v1::BlobChunk chunk;
  chunk.set_digest(std::string(32, 'd'));
  chunk.set_size_bytes(1 << 20);
  chunk.set_data("x");
  for (Upload& upload : uploads) upload.writer = stub->PutBlob(&upload.context, &upload.reply);
  const auto one_is_over = [&] {
    return !std::ranges::all_of(uploads,
                                [&](Upload& upload) { return upload.writer->Write(chunk); });
  };
  EXPECT_TRUE(testing::WaitUntil(one_is_over, 60.0)) << "the others go on and on";
  size_t turned_away = 0;
  for (Upload& upload : uploads) {
    upload.writer->WritesDone();
    if (upload.writer->Finish().error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED) ++turned_away;
  }
  EXPECT_GT(turned_away, 0U);
  EXPECT_LT(turned_away, uploads.size());
  EXPECT_TRUE(server.As("client")->ListJobs().ok()) << "it serves on";
}

TEST(Limits, StreamsBeyondThoseOfAConnectionWait) {
  TlsServer server({.limits = {.streams_per_connection = 2}});
  const auto node = server.As("node");
  const uint64_t session = node->Join(WideWorker(6))->session;
  std::atomic<int> answered{0};
  {
    std::vector<std::jthread> waiting;
    for (uint32_t slot = 0; slot < 6; ++slot) {
      waiting.emplace_back([&, slot] {
        if (node->LeaseTask(session, slot, 0.1).ok()) ++answered;
      });
    }
  }
  EXPECT_EQ(answered, 6);
}

/// A stream of a blob of ten bytes, of which one is sent.
class BegunBlob {
 public:
  explicit BegunBlob(v1::Coordinator::Stub& stub) : writer_(stub.PutBlob(&context_, &reply_)) {
    v1::BlobChunk chunk;
    chunk.set_digest(std::string(32, 'd'));
    chunk.set_size_bytes(10);
    chunk.set_data("x");
    writer_->Write(chunk);
  }
  bool SendOne() {
    v1::BlobChunk chunk;
    chunk.set_data("x");
    return writer_->Write(chunk);
  }
  grpc::StatusCode End() { return writer_->Finish().error_code(); }
  grpc::StatusCode Close() {
    writer_->WritesDone();
    return End();
  }

 private:
  grpc::ClientContext context_;
  v1::PutBlobReply reply_;
  std::unique_ptr<grpc::ClientWriter<v1::BlobChunk>> writer_;
};

TEST(Limits, AStreamThatBringsNothingIsCalledOff) {
  TlsServer server({.limits = {.streams = {.longest_wait_s = 0.4}}});
  const auto stub =
      v1::Coordinator::NewStub(OpenChannel(server.address(), server.keys() + "/client"));
  BegunBlob slow(*stub);
  for (int i = 0; i < 8; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_TRUE(slow.SendOne());
  }
  EXPECT_EQ(slow.Close(), grpc::StatusCode::DATA_LOSS) << "a byte less than was said";
  BegunBlob silent(*stub);
  EXPECT_EQ(silent.End(), grpc::StatusCode::CANCELLED);
}

TEST(Limits, SilentStreamsDoNotKeepOthersOut) {
  constexpr int kThreads = 12;
  TlsServer server({.limits = {.threads = kThreads, .streams = {.most_of_one_peer = 4}}});
  const auto stub =
      v1::Coordinator::NewStub(OpenChannel(server.address(), server.keys() + "/client"));
  std::vector<std::unique_ptr<BegunBlob>> held;
  for (int i = 0; i < 4; ++i) held.push_back(std::make_unique<BegunBlob>(*stub));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  for (int i = 0; i < 3 * kThreads; ++i)
    EXPECT_EQ(BegunBlob(*stub).Close(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_TRUE(server.As("node")->Join(Worker("node")).ok());
  EXPECT_TRUE(server.As("node")->Put("bytes of another").ok());
}

TEST(Limits, AWorkerHasSlotsWithinReason) {
  TlsServer server;
  const auto node = server.As("node");
  for (const uint32_t slots : {0U, 1025U})
    EXPECT_TRUE(absl::IsInvalidArgument(node->Join(WideWorker(slots)).status())) << slots;
  const uint64_t session = node->Join(WideWorker(2))->session;
  EXPECT_TRUE(absl::IsInvalidArgument(node->LeaseTask(session, 2, 0.0).status()));
}

TEST(Limits, WhoNeverEndsAHandshakeKeepsNobodyOut) {
  const TlsServer server;
  // What a greeting in TLS begins with; the rest never comes.
  const std::string greeting("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11);
  std::vector<std::unique_ptr<testing::TcpTalk>> silent;
  for (int i = 0; i < 400; ++i) {
    silent.push_back(std::make_unique<testing::TcpTalk>(server.address()));
    ASSERT_TRUE(silent.back()->IsOpen()) << i;
    if (i % 2 == 0) silent.back()->Say(greeting.substr(0, 1 + i % greeting.size()));
  }
  EXPECT_TRUE(server.As("client")->ListJobs().ok());
  EXPECT_TRUE(server.As("node")->Join(Worker("node")).ok());
}

}  // namespace
}  // namespace orbweave
