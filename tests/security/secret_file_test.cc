// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/secret_file.h"

#include <grp.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/command.h"

namespace orbweave {
namespace {

constexpr uid_t kNobody = 65534;

TEST(SecretFile, IsItsOwnersAlone) {
  const testing::TemporaryFolder folder;
  const std::string path = folder / "key";
  ASSERT_TRUE(WriteSecretFile(path, "first").ok());
  ASSERT_TRUE(WriteSecretFile(path, "second").ok());
  struct stat info {};
  ASSERT_EQ(::stat(path.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600U);
  EXPECT_EQ(*ReadSecretFile(path), "second");
}

TEST(SecretFile, IsNotReadWhenOthersMay) {
  const testing::TemporaryFolder folder;
  const std::string path = folder / "key";
  ASSERT_TRUE(WriteSecretFile(path, "secret").ok());
  for (const mode_t mode : {0640U, 0604U, 0660U}) {
    ASSERT_EQ(::chmod(path.c_str(), mode), 0);
    const absl::Status status = ReadSecretFile(path).status();
    EXPECT_TRUE(absl::IsPermissionDenied(status));
    EXPECT_EQ(std::string(status.message()).find("secret"), std::string::npos);
  }
}

/// Whether a process of nobody's, in the group of nobody's, may read a file by `read`.
template <typename Read>
bool NobodyMay(Read&& read) {
  const pid_t child = ::fork();
  if (child == 0) {
    const gid_t group = kNobody;
    const bool changed =
        ::setgroups(1, &group) == 0 && ::setgid(group) == 0 && ::setuid(kNobody) == 0;
    ::_exit(changed && read().ok() ? 0 : 1);
  }
  int end = 0;
  return ::waitpid(child, &end, 0) == child && WIFEXITED(end) && WEXITSTATUS(end) == 0;
}

TEST(SecretFile, OfRootIsTakenByAGroupItIsFor) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can hand a file to a group";
  const testing::TemporaryFolder folder;
  ASSERT_EQ(::chmod(folder.Path().c_str(), 0755), 0);
  const std::string path = folder / "key";
  ASSERT_TRUE(WriteSecretFile(path, "secret").ok());
  const auto may_read = [&path](uid_t owner, gid_t group, mode_t mode) {
    EXPECT_EQ(::chown(path.c_str(), owner, group), 0);
    EXPECT_EQ(::chmod(path.c_str(), mode), 0);
    return NobodyMay([&path] { return ReadSecretFile(path); });
  };
  EXPECT_TRUE(may_read(0, kNobody, 0440));
  EXPECT_TRUE(may_read(0, kNobody, 0640));
  EXPECT_TRUE(may_read(kNobody, kNobody, 0600));
  EXPECT_FALSE(may_read(0, kNobody, 0444)) << "everybody may read it";
  EXPECT_FALSE(may_read(0, kNobody, 0460)) << "the group may change it";
  EXPECT_FALSE(may_read(kNobody, kNobody, 0640)) << "it is not an engine's";
  EXPECT_FALSE(may_read(1, kNobody, 0440)) << "it is another user's";
}

TEST(SecretFile, IsTrustedWhenOthersMayReadButNotChangeIt) {
  const testing::TemporaryFolder folder;
  const std::string path = folder / "ca.crt";
  ASSERT_TRUE(WriteSecretFile(path, "public").ok());
  for (const mode_t mode : {0600U, 0640U, 0644U, 0444U}) {
    ASSERT_EQ(::chmod(path.c_str(), mode), 0);
    EXPECT_EQ(ReadTrustedFile(path).value_or("refused"), "public") << mode;
  }
  for (const mode_t mode : {0620U, 0602U, 0666U}) {
    ASSERT_EQ(::chmod(path.c_str(), mode), 0);
    EXPECT_TRUE(absl::IsPermissionDenied(ReadTrustedFile(path).status())) << mode;
  }
}

TEST(SecretFile, SaysWhatIsMissing) {
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(absl::IsNotFound(ReadSecretFile(folder / "none").status()));
  EXPECT_FALSE(ReadSecretFile(folder.Path()).ok());
  EXPECT_TRUE(absl::IsNotFound(WriteSecretFile(folder / "no/folder", "x")));
}

}  // namespace
}  // namespace orbweave
