// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What a worker says of its task, spoilt on the wire: refused, and the task is still the worker's.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <limits>

#include "core/base/random.h"
#include "core/pipeline/build_version.h"
#include "orbweave/v1/coordinator.grpc.pb.h"
#include "proto/codec/coordinator_codec.h"
#include "tests/support/grpc_raw_call.h"
#include "tests/support/tls_server.h"
#include "worker/grpc_channel.h"
#include "worker/task_runner.h"

namespace orbweave {
namespace {

class MalformedReports : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto client = server_.As("client");
    job_ = *client->SubmitJob(*testing::PrepareToyJob(*client, "1"));
    session_ = node_->Join({.name = "node", .version = std::string(BuildVersion())})->session;
    lease_ = **node_->LeaseTask(session_, 0, 10.0);
  }

  /// The worker's word that its task is done, with everything right.
  v1::CompleteTaskRequest Done() {
    const SteadyClock clock;
    const auto result = RunTask(testing::LookupIn(stages_), lease_.spec, *node_, {}, clock);
    v1::CompleteTaskRequest request;
    request.set_session(session_);
    *request.mutable_lease() = ToProto(lease_);
    *request.mutable_result() = ToProto(*result);
    return request;
  }

  grpc::StatusCode Complete(const v1::CompleteTaskRequest& request) {
    grpc::ClientContext context;
    v1::Empty reply;
    return stub_->CompleteTask(&context, request, &reply).error_code();
  }

  grpc::StatusCode Fail(uint32_t code) {
    v1::FailTaskRequest request;
    request.set_session(session_);
    *request.mutable_lease() = ToProto(lease_);
    request.set_code(code);
    grpc::ClientContext context;
    v1::Empty reply;
    return stub_->FailTask(&context, request, &reply).error_code();
  }

  void ExpectTheTaskIsStillOurs() {
    const auto heard = node_->Heartbeat(session_, {{lease_.task, lease_.epoch, {}}});
    ASSERT_TRUE(heard.ok()) << heard.status();
    EXPECT_TRUE(heard->cancelled.empty());
  }

  testing::TlsServer server_;
  testing::StageMap stages_ = testing::ToyStages();
  std::unique_ptr<GrpcCoordinatorClient> node_ = server_.As("node");
  std::shared_ptr<grpc::Channel> channel_ =
      OpenChannel(server_.address(), server_.keys() + "/node");
  std::unique_ptr<v1::Coordinator::Stub> stub_ = v1::Coordinator::NewStub(channel_);
  Digest job_{};
  uint64_t session_ = 0;
  Lease lease_{};
};

TEST_F(MalformedReports, OfHowLongToWaitAreRefused) {
  using Limits = std::numeric_limits<double>;
  for (const double wait_s : {Limits::quiet_NaN(), Limits::infinity(), -1.0}) {
    v1::LeaseTaskRequest request;
    request.set_session(session_);
    request.set_wait_s(wait_s);
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(10));
    v1::LeaseTaskReply reply;
    EXPECT_EQ(stub_->LeaseTask(&context, request, &reply).error_code(),
              grpc::StatusCode::INVALID_ARGUMENT)
        << wait_s;
  }
}

TEST_F(MalformedReports, OfTasksAreRefused) {
  using Spoil = std::function<void(v1::CompleteTaskRequest&)>;
  const std::vector<Spoil> ways = {
      [](auto& request) { request.clear_lease(); },
      [](auto& request) { request.clear_result(); },
      [](auto& request) { request.mutable_lease()->set_task(std::string(31, 'd')); },
      [](auto& request) { request.mutable_lease()->mutable_spec()->add_inputs("short"); },
      [](auto& request) { request.mutable_result()->add_outputs(""); },
      [](auto& request) { request.mutable_result()->add_outputs(std::string(33, 'd')); },
      [](auto& request) { request.mutable_result()->add_recipes(std::string(1'000'000, 'd')); }};
  const v1::CompleteTaskRequest done = Done();
  for (size_t i = 0; i < ways.size(); ++i) {
    v1::CompleteTaskRequest spoilt = done;
    ways[i](spoilt);
    EXPECT_EQ(Complete(spoilt), grpc::StatusCode::INVALID_ARGUMENT) << i;
    ExpectTheTaskIsStillOurs();
  }
  v1::CompleteTaskRequest never_put = done;
  never_put.mutable_result()->add_outputs(std::string(32, 'd'));
  EXPECT_EQ(Complete(never_put), grpc::StatusCode::ABORTED) << "it may be there in a moment";
  ExpectTheTaskIsStillOurs();
  EXPECT_EQ(Complete(done), grpc::StatusCode::OK);
}

TEST_F(MalformedReports, ThatAreNoMessagesAreRefused) {
  const v1::CompleteTaskRequest done = Done();
  const auto answer_to = [this](const std::string& method, const std::string& bytes) {
    return testing::RawCall(channel_, "/orbweave.v1.Coordinator/" + method, bytes)
        .status.error_code();
  };
  for (const char* method : {"CompleteTask", "FailTask", "Heartbeat", "LeaseTask"}) {
    Random random(std::string_view{method});
    for (int i = 0; i < 20; ++i) {
      std::string noise(1 + random.Index(200), '\0');
      for (char& byte : noise) byte = static_cast<char>(random.Index(256));
      EXPECT_NE(answer_to(method, noise), grpc::StatusCode::OK) << method << i;
    }
  }
  const std::string whole = done.SerializeAsString();
  for (size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(answer_to("CompleteTask", whole.substr(0, size)), grpc::StatusCode::OK) << size;
  ExpectTheTaskIsStillOurs();
  EXPECT_EQ(Complete(done), grpc::StatusCode::OK);
}

TEST_F(MalformedReports, OfFailuresNeedAReason) {
  EXPECT_EQ(Fail(0), grpc::StatusCode::INVALID_ARGUMENT);
  ExpectTheTaskIsStillOurs();
}

TEST_F(MalformedReports, OfFailuresOfAnUnknownKindAreFailures) {
  EXPECT_EQ(Fail(4'000'000'000), grpc::StatusCode::OK);
  const auto heard = node_->Heartbeat(session_, {{lease_.task, lease_.epoch, {}}});
  EXPECT_THAT(heard->cancelled, ::testing::ElementsAre(lease_.task));
  EXPECT_EQ(server_.As("client")->GetJob(job_)->state, JobState::kRunning) << "it is tried again";
}

}  // namespace
}  // namespace orbweave
