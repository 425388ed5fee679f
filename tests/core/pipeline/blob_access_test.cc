// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/blob_access.h"

#include <gtest/gtest.h>

#include "tests/support/memory_blobs.h"

namespace orbweave {
namespace {

TEST(PiecesOf, GivesAllBytesInOrderAndThenNone) {
  for (const size_t size : {size_t{0}, size_t{1}, kPieceBytes, 2 * kPieceBytes + 3}) {
    std::string bytes(size, 'x');
    for (size_t i = 0; i < size; i += 1000) bytes[i] = static_cast<char>(i / 1000);
    const NextPiece next = PiecesOf(bytes);
    std::string all;
    for (std::string_view piece = *next(); !piece.empty(); piece = *next()) all += piece;
    EXPECT_TRUE(all == bytes) << size;
    EXPECT_TRUE(next()->empty());
  }
}

TEST(BlobAccess, ReadsInPiecesWhatWasWrittenInPieces) {
  testing::MemoryBlobs blobs;
  const std::string bytes(kPieceBytes + 1, 'x');
  ASSERT_TRUE(blobs.Write(DigestOf(bytes), bytes.size(), PiecesOf(bytes)).ok());
  std::string back;
  ASSERT_TRUE(blobs
                  .Read(DigestOf(bytes),
                        [&back](std::string_view piece) {
                          back += piece;
                          return absl::OkStatus();
                        })
                  .ok());
  EXPECT_TRUE(back == bytes);
}

TEST(BlobAccess, StoresNothingUnderANameThatIsNotItsOwn) {
  testing::MemoryBlobs blobs;
  EXPECT_TRUE(absl::IsDataLoss(blobs.Write(DigestOf("a"), 1, PiecesOf("b"))));
  EXPECT_TRUE(absl::IsDataLoss(blobs.Write(DigestOf("a"), 2, PiecesOf("a"))));
  EXPECT_TRUE(absl::IsNotFound(blobs.Get(DigestOf("a")).status()));
  EXPECT_TRUE(absl::IsNotFound(blobs.Get(DigestOf("b")).status()));
}

}  // namespace
}  // namespace orbweave
