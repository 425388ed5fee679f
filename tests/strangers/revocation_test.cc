// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Participants who are shut out, and callers no handshake takes: real connections.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "security/handshake_probe.h"
#include "security/secret_file.h"
#include "tests/support/tls_server.h"
#include "worker/grpc_enrollment_client.h"
#include "worker/refused_handshake.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using testing::TlsServer;
using testing::Worker;

std::string SerialOf(const TlsServer& server, const std::string& name) {
  return CheckTlsFolder({server.keys() + "/" + name})->serial;
}

/// Keys of another fleet that know this one's authority, so that it is the server who refuses.
std::string ForeignKeys(const TlsServer& server) {
  const std::string folder = testing::MakeKeys(server.folder() / "foreign") + "/node";
  const std::string ca = *ReadSecretFile(server.keys() + "/node/ca.crt");
  ORBWEAVE_CHECK(WriteSecretFile(folder + "/ca.crt", ca).ok());
  return folder;
}

TEST(Revoked, IsRefusedAtItsNextCallThoughItIsConnected) {
  TlsServer server;
  const auto client = server.As("client");
  ASSERT_TRUE(client->SubmitJob(*testing::PrepareToyJob(*client, "1")).ok());
  const auto node = server.As("node");
  const uint64_t session = node->Join(Worker("node"))->session;
  const Lease lease = **node->LeaseTask(session, 0, 10.0);
  ASSERT_TRUE(Revoke(server.keys(), {.names = {"node"}}).ok());
  EXPECT_TRUE(absl::IsPermissionDenied(node->Heartbeat(session, {}).status()));
  EXPECT_TRUE(absl::IsPermissionDenied(node->CompleteTask(session, lease, {})));
  EXPECT_TRUE(absl::IsPermissionDenied(node->LeaseTask(session, 0, 0.0).status()));
  EXPECT_TRUE(absl::IsPermissionDenied(node->Put("bytes").status()));
  EXPECT_TRUE(absl::IsPermissionDenied(node->Join(Worker("node")).status()));
  EXPECT_TRUE(server.As("other")->Join(Worker("other")).ok());
}

TEST(Revoked, IsToldSoWhileItWaitsForATask) {
  TlsServer server;
  const auto node = server.As("node");
  const uint64_t session = node->Join(Worker("node"))->session;
  absl::Status told;
  std::jthread waiting([&] { told = node->LeaseTask(session, 0, 3600.0).status(); });
  const auto other = server.As("other");
  const uint64_t others = other->Join(Worker("other"))->session;
  ASSERT_TRUE(Revoke(server.keys(), {.names = {"node"}}).ok());
  waiting.join();  // an hour before its time
  EXPECT_TRUE(absl::IsPermissionDenied(told)) << told;
  const auto client = server.As("client");
  ASSERT_TRUE(client->SubmitJob(*testing::PrepareToyJob(*client, "1")).ok());
  EXPECT_TRUE((*other->LeaseTask(others, 0, 30.0)).has_value())
      << "others are given tasks as before";
}

TEST(Revoked, LosesStreamsThatHaveBegun) {
  TlsServer server;
  const auto client = server.As("client");
  // More than a connection buffers: what is sent whole before its peer is shut out is not lost.
  const Digest blob = *client->Put(std::string(64 << 20, 'y'));
  const auto node = server.As("node");
  absl::Status read = absl::OkStatus();
  absl::Status wrote = absl::OkStatus();
  std::atomic<bool> reads{false};
  std::atomic<bool> writes{false};
  std::atomic<bool> has_lost_one{false};
  std::jthread reader([&] {
    read = node->Read(blob, [&](std::string_view) {
      reads = true;
      testing::WaitUntil([&] { return has_lost_one.load(); }, 300.0);
      return absl::OkStatus();
    });
  });
  ASSERT_TRUE(testing::WaitUntil([&] { return reads.load(); }, 60.0));
  // A byte at a time, and never to an end.
  std::jthread writer([&] {
    wrote = node->Write(DigestOf("x"), 1 << 30, [&]() -> absl::StatusOr<std::string_view> {
      writes = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return "x";
    });
    has_lost_one = true;
  });
  ASSERT_TRUE(testing::WaitUntil([&] { return writes.load(); }, 60.0));
  ASSERT_TRUE(Revoke(server.keys(), {.names = {"node"}}).ok());
  writer.join();
  reader.join();
  EXPECT_FALSE(wrote.ok());
  EXPECT_FALSE(read.ok());
  EXPECT_TRUE(client->Get(blob).ok()) << "others are not disturbed";
}

TEST(Revoked, LosesAllOfHundredsOfCallsAndDisturbsNobodyElse) {
  constexpr uint32_t kWaiting = 150;
  TlsServer server;
  const auto node = server.As("node");
  WorkerInfo many = Worker("node");
  many.slots = kWaiting;
  const uint64_t session = node->Join(many)->session;
  std::atomic<uint32_t> refused{0};
  std::vector<std::jthread> calls;
  for (uint32_t slot = 0; slot < kWaiting; ++slot) {
    calls.emplace_back([&, slot] {
      if (absl::IsPermissionDenied(node->LeaseTask(session, slot, 3600.0).status())) ++refused;
    });
  }
  const auto busy = server.As("node");
  std::atomic<bool> is_busy_refused{false};
  calls.emplace_back([&] {  // and calls that come all the while
    while (!absl::IsPermissionDenied(busy->Heartbeat(session, {}).status())) {
    }
    is_busy_refused = true;
  });
  const auto other = server.As("other");
  const uint64_t others = other->Join(Worker("other"))->session;
  const auto client = server.As("client");
  ASSERT_TRUE(Revoke(server.keys(), {.names = {"node"}}).ok());
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(other->Heartbeat(others, {}).ok());
  calls.clear();  // joins: an hour before their time
  EXPECT_EQ(refused, kWaiting);
  EXPECT_TRUE(is_busy_refused);
  ASSERT_TRUE(client->SubmitJob(*testing::PrepareToyJob(*client, "1")).ok());
  EXPECT_TRUE((*other->LeaseTask(others, 0, 30.0)).has_value());
}

TEST(Revoked, StaysOutAfterARestartAndGetsNoNewCertificate) {
  TlsServer server;
  ASSERT_TRUE(Revoke(server.keys(), {.names = {"node"}}).ok());
  server.Restart();
  const absl::Status refused = server.As("node")->Join(Worker("node")).status();
  EXPECT_TRUE(absl::IsPermissionDenied(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), HasSubstr("orbweave://city/worker/node is revoked"));
  EXPECT_TRUE(
      absl::IsPermissionDenied(RenewCertificate(server.address(), {server.keys() + "/node"})));
}

TEST(Revoked, ByItsSerialIsOneCertificateAlone) {
  TlsServer server;
  ASSERT_TRUE(Revoke(server.keys(), {.serials = {SerialOf(server, "client")}}).ok());
  EXPECT_TRUE(absl::IsPermissionDenied(server.As("client")->ListJobs().status()));
  EXPECT_TRUE(server.As("admin")->ListJobs().ok());
}

TEST(ProbeHandshake, SaysWhoRefusedWhom) {
  TlsServer server;
  const std::string foreign = ForeignKeys(server);
  const auto probe = [&](const std::string& folder) {
    return ProbeHandshake(server.address(), {folder}, Caller::kCertified);
  };
  EXPECT_EQ(probe(server.keys() + "/node"), Handshake::kCompleted);
  EXPECT_EQ(probe(foreign), Handshake::kCallerRefused);
  EXPECT_EQ(probe(server.folder() / "foreign/client"), Handshake::kServerRefused);
  EXPECT_EQ(ProbeHandshake(server.address(), {foreign}, Caller::kStranger), Handshake::kCompleted)
      << "this coordinator lets strangers enrol";
}

TEST(ProbeHandshake, SaysNothingOfACoordinatorThatIsAway) {
  TlsServer server;
  const TlsFolder node{server.keys() + "/node"};
  for (const char* address : {"127.0.0.1:1", "nonsense", "[::1]:1"})
    EXPECT_EQ(ProbeHandshake(address, node, Caller::kCertified), Handshake::kUnclear) << address;
}

TEST(RefusedHandshake, IsToldFromACoordinatorThatIsAway) {
  TlsServer server;
  const absl::Status away = absl::UnavailableError("away");
  RefusedHandshake known(server.address(), server.keys() + "/node");
  RefusedHandshake foreign(server.address(), ForeignKeys(server));
  RefusedHandshake plain(server.address(), "");
  absl::Status explained = away;
  EXPECT_TRUE(testing::WaitUntil(
      [&] {
        EXPECT_EQ(known.Explain(away), away);
        EXPECT_EQ(plain.Explain(away), away);
        explained = foreign.Explain(away);
        return !absl::IsUnavailable(explained);
      },
      30.0));
  EXPECT_TRUE(absl::IsUnauthenticated(explained)) << explained;
  EXPECT_THAT(std::string(explained.message()), HasSubstr("another authority"));
  EXPECT_EQ(foreign.Explain(absl::NotFoundError("x")), absl::NotFoundError("x"));
}

}  // namespace
}  // namespace orbweave
