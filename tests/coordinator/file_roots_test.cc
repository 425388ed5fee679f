// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/file_roots.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/command.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

class ResolveBeneathTest : public ::testing::Test {
 protected:
  ResolveBeneathTest() {
    testing::WriteAll(folder_ / "root/street/a.jpg", "pixels");
    testing::WriteAll(folder_ / "secret", "secret");
    testing::WriteAll(folder_ / "root2/b.jpg", "another's");
  }
  [[nodiscard]] absl::StatusOr<std::string> Resolve(const std::string& relative) const {
    return ResolveBeneath({{"data", folder_ / "root"}}, "data", relative);
  }
  testing::TemporaryFolder folder_;
};

TEST_F(ResolveBeneathTest, FindsFilesAndNamesThemWithoutLinks) {
  const std::string path = fs::canonical(folder_ / "root/street/a.jpg").string();
  EXPECT_EQ(*Resolve("street/a.jpg"), path);
  EXPECT_EQ(*Resolve("./street/../street//a.jpg"), path);
  fs::create_symlink("a.jpg", folder_ / "root/street/link.jpg");
  EXPECT_EQ(*Resolve("street/link.jpg"), path) << "a link that stays beneath";
}

TEST_F(ResolveBeneathTest, RefusesEveryWayOut) {
  fs::create_symlink("../../secret", folder_ / "root/street/up");
  fs::create_symlink(folder_ / "secret", folder_ / "root/street/absolute");
  fs::create_symlink("..", folder_ / "root/above");
  fs::create_symlink("/proc/self/root", folder_ / "root/magic");
  for (const std::string& path : {std::string("../secret"),
                                  std::string("street/../../secret"),
                                  std::string("../root2/b.jpg"),
                                  std::string("../root/street/a.jpg"),
                                  folder_ / "secret",
                                  folder_ / "root/street/a.jpg",
                                  std::string("street/up"),
                                  std::string("street/absolute"),
                                  std::string("above/secret"),
                                  std::string("magic/etc/passwd")}) {
    EXPECT_TRUE(absl::IsPermissionDenied(Resolve(path).status()))
        << path << " " << Resolve(path).status();
  }
}

TEST_F(ResolveBeneathTest, RefusesWhatIsNoPathAndNoFile) {
  EXPECT_TRUE(absl::IsInvalidArgument(Resolve("").status()));
  EXPECT_TRUE(absl::IsInvalidArgument(Resolve(std::string("street/a.jpg\0.png", 17)).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(Resolve("street").status()));
  EXPECT_TRUE(absl::IsInvalidArgument(Resolve(".").status()));
  ASSERT_EQ(::mkfifo((folder_ / "root/pipe").c_str(), 0600), 0);
  EXPECT_TRUE(absl::IsInvalidArgument(Resolve("pipe").status()));
}

TEST_F(ResolveBeneathTest, SaysWhatIsMissing) {
  EXPECT_TRUE(absl::IsNotFound(Resolve("street/b.jpg").status()));
  EXPECT_TRUE(absl::IsNotFound(ResolveBeneath({}, "data", "a").status()));
  EXPECT_TRUE(absl::IsNotFound(ResolveBeneath({{"data", folder_ / "gone"}}, "data", "a").status()));
  fs::create_symlink("loop", folder_ / "root/loop");
  EXPECT_FALSE(Resolve("loop").ok());
}

}  // namespace
}  // namespace orbweave
