// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Who gets in: real connections with real certificates.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "security/certificate_authority.h"
#include "security/certificate_request.h"
#include "security/secret_file.h"
#include "tests/support/tls_server.h"
#include "tests/support/wait_for_end.h"
#include "worker/task_runner.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using testing::TlsServer;
using testing::Worker;

TEST(Certificates, CarryAJobFromSubmissionToAnswer) {
  TlsServer server;
  const auto client = server.As("client");
  const auto worker = server.As("node");
  const Digest job = *client->SubmitJob(*testing::PrepareToyJob(*client, "1 2"));
  const uint64_t session = worker->Join(Worker("node"))->session;
  const testing::StageMap stages = testing::ToyStages();
  const SteadyClock clock;
  for (int i = 0; i < 4; ++i) {
    const auto lease = worker->LeaseTask(session, 0, 10.0);
    ASSERT_TRUE(lease.ok() && lease->has_value()) << lease.status();
    const auto result = RunTask(testing::LookupIn(stages), (*lease)->spec, *worker, {}, clock);
    ASSERT_TRUE(worker->CompleteTask(session, **lease, *result).ok());
  }
  EXPECT_EQ(testing::WaitForEnd(*client, job)->state, JobState::kDone);
  EXPECT_EQ(*testing::ToyAnswer(*client, job), "5");
}

TEST(Certificates, ThoseOfAnotherAuthorityAreWorthNothing) {
  TlsServer server;
  const std::string foreign = testing::MakeKeys(server.folder() / "foreign");
  // The stranger knows the right authority, so that it is the server who refuses.
  const std::string ca = *ReadSecretFile(server.keys() + "/client/ca.crt");
  ASSERT_TRUE(WriteSecretFile(foreign + "/admin/ca.crt", ca).ok());
  GrpcCoordinatorClient stranger(server.address(), {.tls_folder = foreign + "/admin"});
  EXPECT_TRUE(absl::IsUnavailable(stranger.ListJobs().status()));
  EXPECT_TRUE(server.As("admin")->ListJobs().ok());
}

TEST(Certificates, AreAskedOfEverybody) {
  TlsServer server;
  GrpcCoordinatorClient plain(server.address());
  EXPECT_FALSE(plain.ListJobs().ok());
}

TEST(Certificates, OfAServerOfAnotherAuthorityAreRefusedByTheCaller) {
  TlsServer server;
  const std::string foreign = testing::MakeKeys(server.folder() / "foreign");
  GrpcCoordinatorClient deceived(server.address(), {.tls_folder = foreign + "/client"});
  EXPECT_TRUE(absl::IsUnavailable(deceived.ListJobs().status()));
}

TEST(Certificates, OfAWorkerDoNotMakeACoordinator) {
  TlsServer server;
  const auto posing = GrpcServer::Start(
      server.coordinator(), "127.0.0.1:0", {.tls_folder = server.keys() + "/node"});
  EXPECT_TRUE(absl::IsInvalidArgument(posing.status()));
  EXPECT_THAT(std::string(posing.status().message()), HasSubstr("not of a coordinator"));
}

TEST(Certificates, OfAnotherFleetUnderTheSameAuthorityAreRefused) {
  // A site's authority may certify for several fleets: here the coordinator is of another one.
  TlsServer server;
  const auto own = *CertificateAuthority::Make("village", UnixNow(), 3600);
  const auto authority = *CertificateAuthority::Load(own);
  const std::string key = *MakePrivateKey();
  const std::string folder = server.keys() + "/client";
  const auto certificate = authority.Issue(
      *MakeCertificateRequest(key),
      {.identity = {"village", Role::kClient, "client"}, .now_unix_s = UnixNow(), .valid_s = 3600});
  ASSERT_TRUE(certificate.ok());
  const std::string ca = *ReadSecretFile(folder + "/ca.crt");
  ASSERT_TRUE(WriteSecretFile(folder + "/own.key", key).ok());
  ASSERT_TRUE(WriteSecretFile(folder + "/own.crt", *certificate).ok());
  ASSERT_TRUE(
      WriteSecretFile(server.keys() + "/coordinator/ca.crt", ca + own.certificate_pem).ok());
  server.Restart();
  const absl::Status refused = server.As("client")->ListJobs().status();
  EXPECT_TRUE(absl::IsPermissionDenied(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), HasSubstr("fleet city"));
}

TEST(Certificates, ThatHaveEndedAreRefused) {
  TlsServer server;
  ASSERT_TRUE(AddKeys(server.keys(), {.name = "late", .valid_s = 60}, UnixNow() - 3600).ok());
  EXPECT_TRUE(absl::IsUnauthenticated(server.As("late")->Join(Worker("late")).status()));
}

TEST(Sessions, BelongToTheCertificateThatBeganThem) {
  TlsServer server;
  const auto client = server.As("client");
  ASSERT_TRUE(client->SubmitJob(*testing::PrepareToyJob(*client, "1")).ok());
  const auto node = server.As("node");
  const auto other = server.As("other");
  const uint64_t session = node->Join(Worker("node"))->session;
  const Lease lease = **node->LeaseTask(session, 0, 10.0);
  ASSERT_TRUE(other->Join(Worker("other")).ok());
  EXPECT_TRUE(absl::IsPermissionDenied(other->Heartbeat(session, {}).status()));
  EXPECT_TRUE(absl::IsPermissionDenied(other->LeaseTask(session, 0, 0.0).status()));
  EXPECT_TRUE(absl::IsPermissionDenied(other->CompleteTask(session, lease, {})));
  EXPECT_TRUE(
      absl::IsPermissionDenied(other->FailTask(session, lease, absl::InternalError("mine"))));
  EXPECT_TRUE(absl::IsPermissionDenied(other->Leave(session)));
  EXPECT_TRUE(absl::IsPermissionDenied(server.As("admin")->Leave(session)));
  EXPECT_TRUE(node->Heartbeat(session, {{lease.task, lease.epoch, {}}})->cancelled.empty());
}

TEST(Sessions, AnotherWorkersLeaseIsOfNoUse) {
  TlsServer server;
  const auto client = server.As("client");
  ASSERT_TRUE(client->SubmitJob(*testing::PrepareToyJob(*client, "1")).ok());
  const auto node = server.As("node");
  const auto other = server.As("other");
  const uint64_t session = node->Join(Worker("node"))->session;
  const Lease lease = **node->LeaseTask(session, 0, 10.0);
  const uint64_t others = other->Join(Worker("other"))->session;
  EXPECT_TRUE(absl::IsFailedPrecondition(other->CompleteTask(others, lease, {})));
  EXPECT_TRUE(
      absl::IsFailedPrecondition(other->FailTask(others, lease, absl::InternalError("mine"))));
  EXPECT_THAT(other->Heartbeat(others, {{lease.task, lease.epoch, {}}})->cancelled,
              ::testing::ElementsAre(lease.task));
  EXPECT_TRUE(node->Heartbeat(session, {{lease.task, lease.epoch, {}}})->cancelled.empty());
}

TEST(Sessions, NobodyJoinsUnderAnothersName) {
  TlsServer server;
  EXPECT_TRUE(absl::IsPermissionDenied(server.As("other")->Join(Worker("node")).status()));
  EXPECT_TRUE(server.As("other")->Join(Worker("other/second")).ok());
}

TEST(Sessions, AfterARestartAWorkerJoinsAgain) {
  TlsServer server;
  const auto node = server.As("node");
  const uint64_t session = node->Join(Worker("node"))->session;
  server.Restart();
  const auto again = server.As("node");
  EXPECT_TRUE(absl::IsNotFound(again->Heartbeat(session, {}).status()));
  EXPECT_TRUE(again->Join(Worker("node")).ok());
}

}  // namespace
}  // namespace orbweave
