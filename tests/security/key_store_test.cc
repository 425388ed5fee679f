// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/key_store.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "security/join_token.h"
#include "security/secret_file.h"
#include "security/tls_folder.h"
#include "tests/support/command.h"

namespace orbweave {
namespace {

constexpr int64_t kNow = 1'800'000'000;

class KeyStore : public ::testing::Test {
 protected:
  void SetUp() override {
    const absl::Status made = MakeKeyStore(store_, "city", {"host.example"}, kNow);
    ASSERT_TRUE(made.ok()) << made;
  }
  testing::TemporaryFolder folder_;
  std::string store_ = folder_ / "keys";
};

TEST_F(KeyStore, HasAFolderForEachRoleThatIsAskedToCall) {
  for (const char* name : {"coordinator", "client", "admin"}) {
    const auto facts = CheckTlsFolder({store_ + "/" + name});
    ASSERT_TRUE(facts.ok()) << facts.status();
    EXPECT_EQ(facts->identity.ToUri(), std::string("orbweave://city/") + name + "/" + name);
  }
}

TEST_F(KeyStore, IsItsOwnersAlone) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(store_)) {
    struct stat info {};
    ASSERT_EQ(::stat(entry.path().c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, entry.is_directory() ? 0700U : 0600U) << entry.path();
  }
}

TEST_F(KeyStore, IsNeverOverwritten) {
  const std::string key = *ReadSecretFile(store_ + "/authority/ca.key");
  EXPECT_TRUE(absl::IsAlreadyExists(MakeKeyStore(store_, "city", {}, kNow)));
  EXPECT_TRUE(absl::IsAlreadyExists(AddKeys(store_, {.name = "client"}, kNow)));
  EXPECT_TRUE(absl::IsAlreadyExists(AddKeys(store_, {.name = "authority"}, kNow)));
  EXPECT_EQ(*ReadSecretFile(store_ + "/authority/ca.key"), key);
}

TEST_F(KeyStore, TakesOneMoreParticipant) {
  ASSERT_TRUE(AddKeys(store_, {.name = "node7", .valid_s = 60}, kNow).ok());
  const auto facts = CheckTlsFolder({store_ + "/node7"});
  ASSERT_TRUE(facts.ok()) << facts.status();
  EXPECT_EQ(facts->identity.ToUri(), "orbweave://city/worker/node7");
  EXPECT_EQ(facts->ends_unix_s, kNow + 60);
  EXPECT_TRUE(absl::IsInvalidArgument(AddKeys(store_, {.name = "../node8"}, kNow)));
}

TEST_F(KeyStore, WritesTokensThatTheCoordinatorTakes) {
  const auto number = WriteJoinToken(store_, folder_ / "token", kNow + 60);
  ASSERT_TRUE(number.ok()) << number.status();
  const auto claims = VerifyJoinToken(
      *ReadSecretFile(store_ + "/coordinator/token.key"), *ReadSecretFile(folder_ / "token"), kNow);
  ASSERT_TRUE(claims.ok()) << claims.status();
  EXPECT_EQ(claims->fleet, "city");
  EXPECT_EQ(claims->authority_pem, *ReadSecretFile(store_ + "/client/ca.crt"));
  EXPECT_TRUE(absl::IsNotFound(WriteJoinToken(folder_ / "none", folder_ / "token", kNow).status()));
}

TEST_F(KeyStore, AFolderWithAnothersKeyIsRefused) {
  const TlsFolder client{store_ + "/client"};
  ASSERT_TRUE(WriteSecretFile(client.KeyPath(), *ReadSecretFile(store_ + "/admin/own.key")).ok());
  EXPECT_TRUE(absl::IsInvalidArgument(CheckTlsFolder(client).status()));
  std::filesystem::remove(client.KeyPath());
  EXPECT_TRUE(absl::IsNotFound(CheckTlsFolder(client).status()));
}

}  // namespace
}  // namespace orbweave
