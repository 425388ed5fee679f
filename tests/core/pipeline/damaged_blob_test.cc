// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/damaged_blob.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(BlameBlob, NamesTheBlobOfALossOfData) {
  const Digest blob = DigestOf("blob");
  const absl::Status error = BlameBlob(absl::DataLossError("why"), blob);
  EXPECT_TRUE(absl::IsDataLoss(error));
  EXPECT_EQ(error.message(), "why");
  EXPECT_EQ(BlobToBlame(error), blob);
}

TEST(BlameBlob, KeepsTheFirstName) {
  const absl::Status error = BlameBlob(absl::DataLossError("why"), DigestOf("inner"));
  EXPECT_EQ(BlobToBlame(BlameBlob(error, DigestOf("outer"))), DigestOf("inner"));
}

TEST(BlameBlob, BlamesNoBlobForOtherErrors) {
  for (const absl::Status& error :
       {absl::OkStatus(), absl::NotFoundError("gone"), absl::InvalidArgumentError("bad")}) {
    EXPECT_EQ(BlameBlob(error, DigestOf("blob")), error);
    EXPECT_EQ(BlobToBlame(BlameBlob(error, DigestOf("blob"))), std::nullopt);
  }
  EXPECT_EQ(BlobToBlame(absl::DataLossError("who knows")), std::nullopt);
}

}  // namespace
}  // namespace orbweave
