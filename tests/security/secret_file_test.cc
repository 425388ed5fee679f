// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/secret_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/command.h"

namespace orbweave {
namespace {

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

TEST(SecretFile, SaysWhatIsMissing) {
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(absl::IsNotFound(ReadSecretFile(folder / "none").status()));
  EXPECT_FALSE(ReadSecretFile(folder.Path()).ok());
  EXPECT_TRUE(absl::IsNotFound(WriteSecretFile(folder / "no/folder", "x")));
}

}  // namespace
}  // namespace orbweave
