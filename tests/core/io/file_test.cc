// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/file.h"

#include "tests/core/io/io_test_support.h"

namespace orbweave {
namespace {

TEST(ReadFile, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\n\xff", 5);
  ASSERT_TRUE(WriteFileAtomically(folder / "x.bin", bytes).ok());
  EXPECT_EQ(ReadFile(folder / "x.bin").value(), bytes);
}

TEST(ReadFile, NamesTheMissingFile) {
  const absl::Status status = ReadFile("/nowhere/x.bin").status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_NE(status.message().find("/nowhere/x.bin"), std::string::npos);
}

TEST(ReadFile, RefusesAFolder) {
  const TemporaryFolder folder;
  EXPECT_EQ(ReadFile(folder.path()).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(WriteFileAtomically, ReplacesAndLeavesNothingElse) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "x", "old").ok());
  ASSERT_TRUE(WriteFileAtomically(folder / "x", "new").ok());
  EXPECT_EQ(ReadFile(folder / "x").value(), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(WriteFileAtomically, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  // The temporary file's name is known; as a link to /dev/full it meets a full disk.
  std::filesystem::create_symlink("/dev/full", folder / ("x.tmp" + std::to_string(::getpid())));
  const absl::Status status = WriteFileAtomically(folder / "x", "bytes");
  EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted) << status;
  EXPECT_NE(status.message().find("disk full"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(EnsureWritableFolder, MakesParents) {
  const TemporaryFolder folder;
  EXPECT_TRUE(EnsureWritableFolder(folder / "a/b/c").ok());
  EXPECT_TRUE(std::filesystem::is_empty(folder / "a/b/c"));
}

TEST(EnsureWritableFolder, RefusesAFileInTheWay) {
  const TemporaryFolder folder;
  folder.Write("out", "a file");
  const absl::Status status = EnsureWritableFolder(folder / "out");
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition) << status;
  EXPECT_EQ(EnsureWritableFolder("/proc/orbweave").code(), absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace orbweave
