// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/method_rights.h"

#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "orbweave/v1/coordinator.pb.h"
#include "orbweave/v1/enrollment.pb.h"
#include "security/secret_file.h"
#include "tests/support/grpc_health.h"
#include "tests/support/tls_server.h"
#include "worker/grpc_channel.h"

namespace orbweave {
namespace {

using testing::TlsServer;

/// Every method of every service, as it is called on the wire.
std::set<std::string> MethodsOfTheServices() {
  std::set<std::string> methods;
  for (const auto* file :
       {v1::JobSpec::descriptor()->file(), v1::RenewRequest::descriptor()->file()}) {
    for (int s = 0; s < file->service_count(); ++s) {
      const auto* service = file->service(s);
      for (int m = 0; m < service->method_count(); ++m)
        methods.insert("/" + service->full_name() + "/" + service->method(m)->name());
    }
  }
  return methods;
}

std::set<std::string> MethodsOfTheTable() {
  std::set<std::string> methods;
  for (const MethodRight& right : MethodRights()) methods.emplace(right.method);
  return methods;
}

/// What the server says to an empty message, read or not.
grpc::Status Call(const std::shared_ptr<grpc::Channel>& channel, const std::string& method) {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  grpc::CompletionQueue queue;
  const grpc::Slice empty("");
  const grpc::ByteBuffer nothing(&empty, 1);
  grpc::ByteBuffer reply;
  grpc::Status status;
  const auto call = stub.PrepareUnaryCall(&context, method, nothing, &queue);
  call->StartCall();
  call->Finish(&reply, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  queue.Next(&tag, &ok);
  return status;
}

/// By the gate, in its own words: a handler may have its own reasons to refuse.
bool IsRefusal(const grpc::Status& status) {
  return status.error_code() == grpc::StatusCode::PERMISSION_DENIED &&
         status.error_message().find("may not call") != std::string::npos;
}

constexpr char kHealth[] = "/grpc.health.v1.Health/Check";

TEST(MethodRights, HaveARowForEveryMethodAndNoOther) {
  std::set<std::string> methods = MethodsOfTheServices();
  methods.insert(kHealth);  // gRPC's own service
  EXPECT_EQ(MethodsOfTheTable(), methods);
  EXPECT_EQ(MethodRights().size(), MethodsOfTheTable().size()) << "one row each";
}

TEST(MethodRights, GiveWorkersNoJobsAndClientsNoTasks) {
  for (const MethodRight& right : MethodRights()) {
    const bool is_blob = right.method.ends_with("Blob") || right.method.ends_with("Blobs") ||
                         right.method.ends_with("Upload");
    EXPECT_EQ(right.worker && right.client, is_blob || right.method == kHealth) << right.method;
  }
}

TEST(MethodRights, GiveStrangersNothingButEnrolling) {
  const TlsServer server;
  const auto channel =
      OpenChannelAsStranger(server.address(), *ReadSecretFile(server.keys() + "/client/ca.crt"));
  for (const MethodRight& right : MethodRights()) {
    const bool is_enrolling = right.method == "/orbweave.v1.Enrollment/Enroll";
    // An empty message has no good token: refused too, but by the desk and not by the gate.
    EXPECT_EQ(
        Call(channel, std::string(right.method)).error_code(),
        is_enrolling ? grpc::StatusCode::PERMISSION_DENIED : grpc::StatusCode::UNAUTHENTICATED)
        << right.method;
  }
}

/// With real connections: the table is what the server does, for every role and method.
TEST(MethodRights, AreWhatTheServerDoes) {
  const TlsServer server;
  for (const char* name : {"node", "client", "admin"}) {
    const auto channel = OpenChannel(server.address(), server.keys() + "/" + name);
    const std::string role = name == std::string("node") ? "worker" : name;
    for (const MethodRight& right : MethodRights()) {
      if (right.stranger) continue;  // whoever calls it is asked for a token
      const bool is_allowed = role == "admin" || (role == "worker" ? right.worker : right.client);
      const grpc::Status said = Call(channel, std::string(right.method));
      // Empty messages are wrong in their own ways once they are read; a session 0 is unknown.
      EXPECT_EQ(IsRefusal(said), !is_allowed)
          << role << " " << right.method << " " << said.error_message();
      EXPECT_NE(said.error_code(), grpc::StatusCode::UNAVAILABLE) << role << " " << right.method;
    }
    EXPECT_TRUE(IsRefusal(Call(channel, "/orbweave.v1.Coordinator/NoSuchMethod")));
  }
}

TEST(MethodRights, LetEveryMemberAskForHealth) {
  const TlsServer server;
  for (const char* name : {"node", "client", "admin"}) {
    const auto channel = OpenChannel(server.address(), server.keys() + "/" + name);
    EXPECT_EQ(testing::AskHealth(channel), testing::Health::kServing) << name;
  }
}

TEST(CheckRight, RefusesStrangersAndOtherFleets) {
  const std::string method = "/orbweave.v1.Coordinator/GetJob";
  const Identity client{.fleet = "city", .role = Role::kClient, .name = "client"};
  EXPECT_TRUE(CheckRight(method, client, "city").ok());
  EXPECT_TRUE(absl::IsPermissionDenied(CheckRight(method, client, "village")));
  EXPECT_TRUE(absl::IsUnauthenticated(CheckRight(method, std::nullopt, "city")));
  const Identity coordinator{.fleet = "city", .role = Role::kCoordinator, .name = "coordinator"};
  for (const MethodRight& right : MethodRights())
    EXPECT_TRUE(absl::IsPermissionDenied(CheckRight(right.method, coordinator, "city")));
}

}  // namespace
}  // namespace orbweave
