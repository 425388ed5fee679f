// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/certificate_authority.h"

#include <gtest/gtest.h>

#include "security/certificate.h"
#include "security/certificate_request.h"

namespace orbweave {
namespace {

constexpr int64_t kNow = 1'800'000'000;

CertificateAuthority MakeAuthority(const std::string& fleet) {
  const auto own = CertificateAuthority::Make(fleet, kNow, 86400);
  ORBWEAVE_CHECK(own.ok());
  auto authority = CertificateAuthority::Load(*own);
  ORBWEAVE_CHECK(authority.ok());
  return *std::move(authority);
}

CertificateOrder OrderFor(Role role) {
  return {.identity = {"city", role, "node7"}, .now_unix_s = kNow, .valid_s = 3600};
}

std::string Request() {
  const auto key = MakePrivateKey();
  ORBWEAVE_CHECK(key.ok());
  const auto request = MakeCertificateRequest(*key);
  ORBWEAVE_CHECK(request.ok());
  return *request;
}

/// Whether a certificate is good for `purpose` under an authority at kNow.
bool Verifies(const CertificateAuthority& authority, const std::string& pem, int purpose) {
  const CertificateHandle root = *CertificateFromPem(authority.certificate_pem());
  const CertificateHandle leaf = *CertificateFromPem(pem);
  const std::unique_ptr<X509_STORE, OpenSslDeleter<X509_STORE_free>> store(X509_STORE_new());
  X509_STORE_add_cert(store.get(), root.get());
  const std::unique_ptr<X509_STORE_CTX, OpenSslDeleter<X509_STORE_CTX_free>> context(
      X509_STORE_CTX_new());
  X509_STORE_CTX_init(context.get(), store.get(), leaf.get(), nullptr);
  X509_STORE_CTX_set_purpose(context.get(), purpose);
  X509_STORE_CTX_set_time(context.get(), 0, kNow);
  return X509_verify_cert(context.get()) == 1;
}

TEST(CertificateAuthority, CertifiesAnIdentityForItsTime) {
  const CertificateAuthority authority = MakeAuthority("city");
  const auto pem = authority.Issue(Request(), OrderFor(Role::kWorker));
  ASSERT_TRUE(pem.ok()) << pem.status();
  const auto facts = ReadCertificate(*pem);
  ASSERT_TRUE(facts.ok()) << facts.status();
  EXPECT_EQ(facts->identity, OrderFor(Role::kWorker).identity);
  EXPECT_EQ(facts->begins_unix_s, kNow - 300);
  EXPECT_EQ(facts->ends_unix_s, kNow + 3600);
}

TEST(CertificateAuthority, LetsACoordinatorServeAndOthersCall) {
  const CertificateAuthority authority = MakeAuthority("city");
  for (const Role role : {Role::kCoordinator, Role::kWorker, Role::kClient, Role::kAdmin}) {
    const std::string pem = *authority.Issue(Request(), OrderFor(role));
    const bool serves = role == Role::kCoordinator;
    EXPECT_EQ(Verifies(authority, pem, X509_PURPOSE_SSL_SERVER), serves) << RoleName(role);
    EXPECT_EQ(Verifies(authority, pem, X509_PURPOSE_SSL_CLIENT), !serves) << RoleName(role);
  }
}

TEST(CertificateAuthority, IsNotAnother) {
  const CertificateAuthority authority = MakeAuthority("city");
  const std::string pem = *MakeAuthority("city").Issue(Request(), OrderFor(Role::kWorker));
  EXPECT_FALSE(Verifies(authority, pem, X509_PURPOSE_SSL_CLIENT));
}

TEST(CertificateAuthority, NamesTheHostsOfACoordinator) {
  const CertificateAuthority authority = MakeAuthority("city");
  CertificateOrder order = OrderFor(Role::kCoordinator);
  order.hosts = {"host.example", "10.1.2.3", "::1"};
  const auto pem = authority.Issue(Request(), order);
  ASSERT_TRUE(pem.ok()) << pem.status();
  const CertificateHandle certificate = *CertificateFromPem(*pem);
  EXPECT_EQ(X509_check_host(certificate.get(), "host.example", 0, 0, nullptr), 1);
  EXPECT_EQ(X509_check_host(certificate.get(), "other.example", 0, 0, nullptr), 0);
  EXPECT_EQ(X509_check_ip_asc(certificate.get(), "10.1.2.3", 0), 1);
  EXPECT_EQ(X509_check_ip_asc(certificate.get(), "::1", 0), 1);
  order.hosts = {"host.example,URI:orbweave://city/admin/boss"};
  EXPECT_TRUE(absl::IsInvalidArgument(authority.Issue(Request(), order).status()));
}

TEST(CertificateAuthority, RefusesAnotherFleetAndBadNames) {
  const CertificateAuthority authority = MakeAuthority("city");
  CertificateOrder order = OrderFor(Role::kWorker);
  order.identity.fleet = "village";
  EXPECT_TRUE(absl::IsInvalidArgument(authority.Issue(Request(), order).status()));
  order = OrderFor(Role::kWorker);
  order.identity.name = "a,URI:orbweave://city/admin/a";
  EXPECT_TRUE(absl::IsInvalidArgument(authority.Issue(Request(), order).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(CertificateAuthority::Make("a b", kNow, 60).status()));
}

TEST(CertificateAuthority, RefusesARequestThatIsNotSignedByItsKey) {
  const CertificateAuthority authority = MakeAuthority("city");
  std::string damaged = Request();
  damaged[damaged.size() / 2] = damaged[damaged.size() / 2] == 'A' ? 'B' : 'A';
  for (const std::string& request : {std::string(), std::string("request"), damaged}) {
    EXPECT_TRUE(
        absl::IsInvalidArgument(authority.Issue(request, OrderFor(Role::kWorker)).status()));
  }
}

TEST(CertificateAuthority, IsNotLoadedWithAnothersKey) {
  CertifiedKey own = *CertificateAuthority::Make("city", kNow, 60);
  own.key_pem = *MakePrivateKey();
  EXPECT_TRUE(absl::IsInvalidArgument(CertificateAuthority::Load(own).status()));
}

TEST(ReadCertificate, RefusesAnAuthoritysForItNamesNobody) {
  const CertificateAuthority authority = MakeAuthority("city");
  EXPECT_TRUE(absl::IsInvalidArgument(ReadCertificate(authority.certificate_pem()).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(ReadCertificate("").status()));
}

}  // namespace
}  // namespace orbweave
