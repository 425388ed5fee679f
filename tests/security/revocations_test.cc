// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/revocations.h"

#include <gtest/gtest.h>

#include "security/key_store.h"
#include "security/secret_file.h"
#include "security/tls_folder.h"
#include "tests/support/command.h"

namespace orbweave {
namespace {

constexpr int64_t kNow = 1'800'000'000;

TEST(Revocations, AreTheSameAfterTheirText) {
  const Revocations revoked{.names = {"node7", "a.b_c-d"},
                            .serials = {"0A1B", "FF"},
                            .tokens = {std::string(32, 'a'), std::string(32, '0')}};
  const auto back = RevocationsFromText(RevocationsToText(revoked));
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(*back, revoked);
  EXPECT_EQ(*RevocationsFromText(""), Revocations());
}

TEST(Revocations, RefuseAListThatSaysAnythingElse) {
  for (const char* text : {"node7\n",
                           "name\n",
                           "name a b\n",
                           "name ../x\n",
                           "serial 0a\n",
                           "serial\n",
                           "serial 0x1\n",
                           "names a\n",
                           "token 0123456789abcdef\n",
                           "token 0123456789ABCDEF0123456789ABCDEF\n",
                           "token 0123456789abcdef0123456789abcdef0\n",
                           "name a\r\n"})
    EXPECT_TRUE(absl::IsInvalidArgument(RevocationsFromText(text).status())) << text;
}

class RevocationsOfAFleet : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(MakeKeyStore(store_, "city", {"host.example"}, kNow).ok());
    ASSERT_TRUE(AddKeys(store_, {.name = "node7"}, kNow).ok());
    ASSERT_TRUE(AddKeys(store_, {.name = "node8"}, kNow).ok());
  }
  [[nodiscard]] std::string PemOf(const std::string& name) const {
    return *ReadSecretFile(TlsFolder{store_ + "/" + name}.CertificatePath());
  }
  [[nodiscard]] CertificateFacts FactsOf(const std::string& name) const {
    return *ReadCertificate(PemOf(name));
  }
  [[nodiscard]] absl::Status Check(RevocationList& list, const std::string& name) const {
    return list.Check(FactsOf(name).identity, PemOf(name));
  }

  testing::TemporaryFolder folder_;
  std::string store_ = folder_ / "keys";
  std::string path_ = TlsFolder{store_ + "/coordinator"}.RevocationsPath();
};

TEST_F(RevocationsOfAFleet, AreHeededFromTheNextLookOn) {
  const auto list = *RevocationList::Open(path_, {});
  EXPECT_TRUE(Check(*list, "node7").ok()) << "there is no file";
  ASSERT_TRUE(Revoke(store_, {.names = {"node7"}}).ok());
  EXPECT_TRUE(absl::IsPermissionDenied(Check(*list, "node7")));
  EXPECT_TRUE(Check(*list, "node8").ok());
  ASSERT_TRUE(Revoke(store_, {.serials = {FactsOf("node8").serial}}).ok());
  EXPECT_TRUE(absl::IsPermissionDenied(Check(*list, "node7"))) << "nothing is forgotten";
  EXPECT_TRUE(absl::IsPermissionDenied(Check(*list, "node8")));
  EXPECT_TRUE(Check(*list, "client").ok());
}

TEST_F(RevocationsOfAFleet, ReachCoordinatorsOfBeforeAndAfter) {
  ASSERT_TRUE(AddKeys(store_, {.role = Role::kCoordinator, .name = "east"}, kNow).ok());
  ASSERT_TRUE(Revoke(store_, {.names = {"node7"}}).ok());
  ASSERT_TRUE(AddKeys(store_, {.role = Role::kCoordinator, .name = "west"}, kNow).ok());
  for (const char* name : {"authority", "coordinator", "east", "west"}) {
    const TlsFolder folder{store_ + "/" + name};
    EXPECT_TRUE(ReadRevocations(folder.RevocationsPath())->names.contains("node7")) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(TlsFolder{store_ + "/client"}.RevocationsPath()));
}

TEST_F(RevocationsOfAFleet, KeepTheNameFromBeingGivenAgain) {
  ASSERT_TRUE(Revoke(store_, {.names = {"node9"}}).ok());
  EXPECT_TRUE(absl::IsFailedPrecondition(AddKeys(store_, {.name = "node9"}, kNow)));
}

TEST_F(RevocationsOfAFleet, AreRefusedWhereTheyMeanNothing) {
  EXPECT_TRUE(absl::IsInvalidArgument(Revoke(store_, {.names = {"a b"}})));
  EXPECT_TRUE(absl::IsInvalidArgument(Revoke(store_, {.names = {"x\nname node8"}})));
  EXPECT_TRUE(absl::IsInvalidArgument(Revoke(store_, {.serials = {"no"}})));
  EXPECT_TRUE(absl::IsInvalidArgument(Revoke(store_, {.names = {"coordinator"}})));
  EXPECT_TRUE(
      absl::IsInvalidArgument(Revoke(store_, {.serials = {FactsOf("coordinator").serial}})));
  EXPECT_TRUE(absl::IsNotFound(Revoke(folder_ / "nothing", {.names = {"node7"}})));
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(RevocationsOfAFleet, CountAsTheyWereWhileTheListCannotBeRead) {
  int unreadable = 0;
  ASSERT_TRUE(Revoke(store_, {.names = {"node7"}}).ok());
  const auto list = *RevocationList::Open(path_, [&](const absl::Status&) { ++unreadable; });
  testing::WriteAll(path_, "half a li");
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(absl::IsPermissionDenied(Check(*list, "node7")));
    EXPECT_TRUE(Check(*list, "node8").ok());
  }
  EXPECT_EQ(unreadable, 1) << "it is said once";
  EXPECT_FALSE(RevocationList::Open(path_, {}).ok()) << "a coordinator does not start with it";
}

}  // namespace
}  // namespace orbweave
