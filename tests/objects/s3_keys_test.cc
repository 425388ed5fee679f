// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/s3_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "tests/support/command.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kText[] =
    "# of the city\n[default]\naws_access_key_id = AKID\n aws_secret_access_key=secret/+= \n\n"
    "aws_session_token = token\r\nregion = eu-central-1\n";

TEST(ParseS3Keys, TakesWhatAmazonsToolsWrite) {
  const S3Keys keys = *ParseS3Keys(kText);
  EXPECT_EQ(keys.access_key, "AKID");
  EXPECT_EQ(keys.secret_key, "secret/+=");
  EXPECT_EQ(keys.session_token, "token");
  EXPECT_EQ(keys.region, "eu-central-1");
}

TEST(ParseS3Keys, NamesTheLineAndNeverRepeatsIt) {
  for (const char* text : {"aws_access_key_id = AKID\naws_secret_acces_key = SECRET\n",
                           "aws_access_key_id = AKID\nSECRET\n",
                           "aws_secret_access_key = SECRET\naws_secret_access_key = SECRET\n"}) {
    const absl::Status refused = ParseS3Keys(text).status();
    EXPECT_TRUE(absl::IsInvalidArgument(refused)) << text;
    EXPECT_THAT(std::string(refused.message()), HasSubstr("line 2")) << text;
    EXPECT_THAT(std::string(refused.message()), Not(HasSubstr("SECRET"))) << text;
  }
  EXPECT_FALSE(ParseS3Keys("").ok());
  EXPECT_FALSE(ParseS3Keys("aws_access_key_id = AKID\n").ok());
}

TEST(FindS3Keys, TakesAFileThatNobodyElseMayRead) {
  const testing::TemporaryFolder folder;
  const std::string path = folder / "store.keys";
  testing::WriteAll(path, kText);
  ASSERT_EQ(::chmod(path.c_str(), 0644), 0);
  EXPECT_TRUE(absl::IsPermissionDenied(FindS3Keys(path).status()));
  ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
  EXPECT_EQ(FindS3Keys(path)->access_key, "AKID");
  EXPECT_TRUE(absl::IsNotFound(FindS3Keys(folder / "missing").status()));
}

TEST(FindS3Keys, TakesTheEnvironmentOtherwise) {
  ::unsetenv("AWS_SECRET_ACCESS_KEY");
  ::unsetenv("AWS_REGION");
  ::setenv("AWS_ACCESS_KEY_ID", "AKID", 1);
  EXPECT_THAT(std::string(FindS3Keys("").status().message()), HasSubstr("AWS_SECRET_ACCESS_KEY"));
  ::setenv("AWS_SECRET_ACCESS_KEY", "secret", 1);
  ::setenv("AWS_DEFAULT_REGION", "there", 1);
  EXPECT_EQ(FindS3Keys("")->secret_key, "secret");
  EXPECT_EQ(FindS3Keys("")->region, "there");
  ::setenv("AWS_REGION", "here", 1);
  EXPECT_EQ(FindS3Keys("")->region, "here");
}

}  // namespace
}  // namespace orbweave
