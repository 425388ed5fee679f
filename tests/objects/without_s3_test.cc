// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "objects/s3_store.h"

namespace orbweave {
namespace {

TEST(WithoutObjectStores, SaysWhatIsMissing) {
  const auto store = S3Store::Make(*ParseS3Address("s3://blobs"), {});
  EXPECT_TRUE(absl::IsFailedPrecondition(store.status()));
  EXPECT_THAT(std::string(store.status().message()), ::testing::HasSubstr("libcurl4-openssl-dev"));
}

}  // namespace
}  // namespace orbweave
