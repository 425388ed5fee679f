// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Join tokens for certificates: a real server, and the service behind it with a clock turned by
// hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "core/pipeline/build_version.h"
#include "security/certificate_request.h"
#include "security/join_token.h"
#include "security/secret_file.h"
#include "tests/support/tls_server.h"
#include "worker/grpc_enrollment_client.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::TlsServer;

std::string TokenFor(const TlsServer& server, int64_t valid_s) {
  const std::string path = server.folder() / "token";
  ORBWEAVE_CHECK(WriteJoinToken(server.keys(), path, UnixNow() + valid_s).ok());
  return *ReadSecretFile(path);
}

TEST(Enroll, GivesACertificateWithWhichAWorkerJoins) {
  TlsServer server;
  const TlsFolder fresh{server.folder() / "fresh"};
  const absl::Status enrolled = Enroll(server.address(), TokenFor(server, 60), "host", fresh);
  ASSERT_TRUE(enrolled.ok()) << enrolled;
  const auto own = CheckTlsFolder(fresh);
  ASSERT_TRUE(own.ok()) << own.status();
  EXPECT_EQ(own->identity.role, Role::kWorker);
  EXPECT_THAT(own->identity.name, StartsWith("host-"));
  EXPECT_NEAR(static_cast<double>(own->ends_unix_s - UnixNow()), 86400.0, 60.0);
  GrpcCoordinatorClient worker(server.address(), {.tls_folder = fresh.path});
  EXPECT_TRUE(
      worker.Join({.name = own->identity.name, .version = std::string(BuildVersion())}).ok());
  EXPECT_TRUE(absl::IsPermissionDenied(worker.ListJobs().status()));
}

TEST(Enroll, TakesATokenOnceEvenAcrossARestart) {
  TlsServer server;
  const std::string token = TokenFor(server, 600);
  ASSERT_TRUE(Enroll(server.address(), token, "a", {server.folder() / "a"}).ok());
  const absl::Status again = Enroll(server.address(), token, "b", {server.folder() / "b"});
  EXPECT_TRUE(absl::IsPermissionDenied(again)) << again;
  server.Restart();
  const absl::Status later = Enroll(server.address(), token, "c", {server.folder() / "c"});
  EXPECT_TRUE(absl::IsPermissionDenied(later)) << later;
  EXPECT_THAT(std::string(later.message()), HasSubstr("used before"));
}

TEST(Enroll, RefusesATokenThatHasExpired) {
  TlsServer server;
  const absl::Status late =
      Enroll(server.address(), TokenFor(server, -1), "a", {server.folder() / "a"});
  EXPECT_TRUE(absl::IsPermissionDenied(late));
  EXPECT_THAT(std::string(late.message()), HasSubstr("expired"));
}

TEST(Enroll, RefusesATokenThatIsRevokedAlsoAfterARestart) {
  TlsServer server;
  const std::string token = TokenFor(server, 600);
  const std::string other = TokenFor(server, 600);
  const std::string number = ReadJoinToken(token)->nonce;
  ASSERT_TRUE(Revoke(server.keys(), {.tokens = {number}}).ok());
  for (const char* name : {"a", "b"}) {
    const absl::Status refused = Enroll(server.address(), token, name, {server.folder() / name});
    EXPECT_TRUE(absl::IsPermissionDenied(refused)) << refused;
    EXPECT_THAT(std::string(refused.message()), HasSubstr("token is revoked"));
    server.Restart();
  }
  EXPECT_TRUE(Enroll(server.address(), other, "c", {server.folder() / "c"}).ok());
}

TEST(Enroll, ATokenRevokedOnceItWasUsedLeavesItsWorkerIn) {
  TlsServer server;
  const std::string token = TokenFor(server, 600);
  const TlsFolder own{server.folder() / "a"};
  ASSERT_TRUE(Enroll(server.address(), token, "a", own).ok());
  ASSERT_TRUE(Revoke(server.keys(), {.tokens = {ReadJoinToken(token)->nonce}}).ok());
  EXPECT_TRUE(RenewCertificate(server.address(), own).ok());
}

TEST(Enroll, KeepsATokenFromACoordinatorThatIsNotTheOneItNames) {
  TlsServer server;
  TlsServer posing;
  const std::string token = TokenFor(server, 600);
  EXPECT_TRUE(absl::IsUnavailable(Enroll(posing.address(), token, "a", {server.folder() / "a"})));
  EXPECT_TRUE(Enroll(server.address(), token, "a", {server.folder() / "a"}).ok());
}

TEST(Enroll, IsRefusedWhereTheCoordinatorHasNoAuthority) {
  TlsServer server;
  std::filesystem::remove(server.keys() + "/coordinator/ca.key");
  server.Restart();
  EXPECT_FALSE(Enroll(server.address(), TokenFor(server, 60), "a", {server.folder() / "a"}).ok());
  EXPECT_TRUE(server.As("client")->ListJobs().ok());
}

TEST(Renew, ReplacesTheCertificateAndKeepsNameAndKey) {
  TlsServer server;
  const TlsFolder node{server.keys() + "/node"};
  const std::string before = *ReadSecretFile(node.CertificatePath());
  ASSERT_TRUE(RenewCertificate(server.address(), node).ok());
  EXPECT_NE(*ReadSecretFile(node.CertificatePath()), before);
  EXPECT_EQ(CheckTlsFolder(node)->identity, ReadCertificate(before)->identity);
  EXPECT_TRUE(
      server.As("node")->Join({.name = "node", .version = std::string(BuildVersion())}).ok());
}

TEST(Renew, IsNotForClients) {
  TlsServer server;
  EXPECT_TRUE(
      absl::IsPermissionDenied(RenewCertificate(server.address(), {server.keys() + "/client"})));
}

class EnrollmentOverTime : public ::testing::Test {
 protected:
  EnrollmentOverTime() {
    ORBWEAVE_CHECK(MakeKeyStore(keys_, "city", {}, now_).ok());
    Open();
  }

  void Open() {
    auto enrollment_service = EnrollmentService::Open({.tls = {keys_ + "/coordinator"},
                                                       .used_folder = folder_ / "used",
                                                       .now_unix_s = [this] { return now_; }});
    ORBWEAVE_CHECK(enrollment_service.ok());
    enrollment_service_ = *std::move(enrollment_service);
  }

  std::string Token(int64_t valid_s) {
    ORBWEAVE_CHECK(WriteJoinToken(keys_, folder_ / "token", now_ + valid_s).ok());
    return *ReadSecretFile(folder_ / "token");
  }

  size_t NumRemembered() {
    size_t number = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "used"))
      number += entry.is_regular_file() ? 1 : 0;
    return number;
  }

  testing::TemporaryFolder folder_;
  std::string keys_ = folder_ / "keys";
  std::string request_ = *MakeCertificateRequest(*MakePrivateKey());
  int64_t now_ = 1'800'000'000;
  std::unique_ptr<EnrollmentService> enrollment_service_;
};

TEST_F(EnrollmentOverTime, RemembersATokenUntilItWouldHaveExpired) {
  const std::string token = Token(100);
  ASSERT_TRUE(enrollment_service_->Enroll(token, request_, "a").ok());
  now_ += 99;
  Open();
  EXPECT_TRUE(absl::IsPermissionDenied(enrollment_service_->Enroll(token, request_, "a").status()));
  EXPECT_EQ(NumRemembered(), 1U);
  now_ += 1;
  Open();
  EXPECT_EQ(NumRemembered(), 0U);
  EXPECT_TRUE(absl::IsPermissionDenied(enrollment_service_->Enroll(token, request_, "a").status()));
}

TEST_F(EnrollmentOverTime, ABadRequestDoesNotSpendTheToken) {
  const std::string token = Token(100);
  EXPECT_TRUE(
      absl::IsInvalidArgument(enrollment_service_->Enroll(token, "no request", "a").status()));
  EXPECT_TRUE(
      absl::IsInvalidArgument(enrollment_service_->Enroll(token, request_, "../a").status()));
  EXPECT_TRUE(enrollment_service_->Enroll(token, request_, "a").ok());
}

TEST_F(EnrollmentOverTime, ATokenForSeveralGivesEachItsOwnName) {
  ASSERT_TRUE(WriteJoinToken(keys_, folder_ / "token", now_ + 100, 3).ok());
  const std::string token = *ReadSecretFile(folder_ / "token");
  std::set<std::string> names;
  for (int use = 0; use < 3; ++use) {
    Open();  // uses are remembered by every coordinator on this state
    const auto certificate = enrollment_service_->Enroll(token, request_, "host");
    ASSERT_TRUE(certificate.ok()) << certificate.status();
    names.insert(ReadCertificate(*certificate)->identity.name);
  }
  EXPECT_EQ(names.size(), 3U);
  EXPECT_TRUE(
      absl::IsPermissionDenied(enrollment_service_->Enroll(token, request_, "host").status()));
}

TEST_F(EnrollmentOverTime, WhatWasRememberedAndIsDamagedSpendsNoToken) {
  const std::string token = Token(100);
  ASSERT_TRUE(enrollment_service_->Enroll(token, request_, "a").ok());
  std::ofstream(folder_ / "used/" + ReadJoinToken(token)->nonce) << "nonsense";
  EXPECT_FALSE(enrollment_service_->Enroll(token, request_, "a").ok());
}

TEST_F(EnrollmentOverTime, NoTwoTokensGiveTheSameName) {
  const auto first = enrollment_service_->Enroll(Token(100), request_, "a");
  const auto second = enrollment_service_->Enroll(Token(100), request_, "a");
  EXPECT_NE(ReadCertificate(*first)->identity.name, ReadCertificate(*second)->identity.name);
}

TEST_F(EnrollmentOverTime, RefusesATokenOfAnotherKeyStore) {
  const std::string foreign = folder_ / "foreign";
  ASSERT_TRUE(MakeKeyStore(foreign, "city", {}, now_).ok());
  ASSERT_TRUE(WriteJoinToken(foreign, folder_ / "token", now_ + 100).ok());
  EXPECT_TRUE(absl::IsPermissionDenied(
      enrollment_service_->Enroll(*ReadSecretFile(folder_ / "token"), request_, "a").status()));
}

}  // namespace
}  // namespace orbweave
