// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Participants who are shut out, and callers no handshake takes: real connections.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
