// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/storage/blob_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>

#include "tests/support/command.h"

namespace orbweave {
namespace {

using testing::TemporaryFolder;

void Overwrite(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string PathOf(const TemporaryFolder& folder, const Digest& digest) {
  return folder / (digest.ToHex().substr(0, 2) + "/" + digest.ToHex());
}

TEST(BlobStore, PuttingABlobAgainMendsIt) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder.Path());
  ASSERT_TRUE(store.ok());
  const Digest digest = *store->Put("text");
  for (const char* damaged : {"tekt", "te", ""}) {
    Overwrite(PathOf(folder, digest), damaged);
    EXPECT_TRUE(store->Put("text").ok());
    EXPECT_EQ(store->Get(digest).value_or("gone"), "text") << damaged;
  }
}

TEST(BlobStore, GivesBackWhatWasPut) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder.Path());
  ASSERT_TRUE(store.ok());
  for (const std::string& bytes :
       {std::string("text"), std::string(), std::string(3'000'000, '\0')}) {
    const auto digest = store->Put(bytes);
    ASSERT_TRUE(digest.ok());
    EXPECT_EQ(*digest, DigestOf(bytes));
    EXPECT_EQ(*store->Get(*digest), bytes);
    EXPECT_TRUE(store->Verify(*digest));
    EXPECT_EQ(*store->Put(bytes), *digest);
  }
}

TEST(BlobStore, SaysSoWhenABlobIsNotThere) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder.Path());
  ASSERT_TRUE(store.ok());
  EXPECT_TRUE(absl::IsNotFound(store->Get(DigestOf("nothing")).status()));
  EXPECT_FALSE(store->Has(DigestOf("nothing")));
}

TEST(BlobStore, NoticesDamageAndTakesTheBlobAgain) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder.Path());
  ASSERT_TRUE(store.ok());
  const Digest digest = *store->Put("precious");
  Overwrite(PathOf(folder, digest), "presious");
  EXPECT_TRUE(absl::IsDataLoss(store->Get(digest).status()));
  EXPECT_FALSE(store->Has(digest));
  EXPECT_TRUE(store->Put("precious").ok());
  EXPECT_EQ(*store->Get(digest), "precious");
}

TEST(BlobStore, VerifyNoticesATornFile) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder.Path());
  ASSERT_TRUE(store.ok());
  const Digest digest = *store->Put("precious");
  std::filesystem::resize_file(PathOf(folder, digest), 3);
  EXPECT_TRUE(store->Has(digest));
  EXPECT_FALSE(store->Verify(digest));
  EXPECT_FALSE(store->Has(digest));
}

TEST(BlobStore, ReadsALinkedFileAndNoticesWhenItChanged) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder / "blobs");
  ASSERT_TRUE(store.ok());
  const std::string image = folder / "image.jpg";
  Overwrite(image, "pixels");
  const Digest digest = DigestOf("pixels");
  ASSERT_TRUE(store->LinkFile(digest, image).ok());
  EXPECT_EQ(*store->Get(digest), "pixels");
  Overwrite(image, "others");
  for (int i = 0; i < 2; ++i) {
    const absl::Status changed = store->Get(digest).status();
    EXPECT_TRUE(absl::IsDataLoss(changed)) << i;
    EXPECT_NE(changed.message().find(image + " was changed"), std::string::npos) << changed;
  }
  Overwrite(image, "pixels");
  EXPECT_EQ(*store->Get(digest), "pixels") << "as it was";
  std::filesystem::remove(image);
  const absl::Status gone = store->Get(digest).status();
  EXPECT_TRUE(absl::IsNotFound(gone));
  EXPECT_NE(gone.message().find(image + ", which is gone"), std::string::npos) << gone;
}

TEST(BlobStore, RefusesToLinkWhatIsNotTheFile) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder / "blobs");
  ASSERT_TRUE(store.ok());
  Overwrite(folder / "image.jpg", "pixels");
  EXPECT_TRUE(absl::IsDataLoss(store->LinkFile(DigestOf("other"), folder / "image.jpg")));
  EXPECT_TRUE(absl::IsNotFound(store->LinkFile(DigestOf("pixels"), folder / "missing.jpg")));
  EXPECT_TRUE(absl::IsInvalidArgument(store->LinkFile(DigestOf("pixels"), "image.jpg")));
}

TEST(BlobStore, TakesAndGivesABlobInPieces) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder.Path());
  ASSERT_TRUE(store.ok());
  const std::string bytes(3 * kPieceBytes + 1, 'x');
  const Digest digest = DigestOf(bytes);
  ASSERT_TRUE(store->Write(digest, bytes.size(), PiecesOf(bytes)).ok());
  std::string back;
  ASSERT_TRUE(store
                  ->Read(digest,
                         [&back](std::string_view piece) {
                           EXPECT_LE(piece.size(), kPieceBytes);
                           back += piece;
                           return absl::OkStatus();
                         })
                  .ok());
  EXPECT_TRUE(back == bytes);
  const auto nobody_asks = []() -> absl::StatusOr<std::string_view> {
    return absl::InternalError("it is stored");
  };
  EXPECT_TRUE(store->Write(digest, bytes.size(), nobody_asks).ok());
}

TEST(BlobStore, StoresOnlyThePiecesThatWereNamed) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder.Path());
  ASSERT_TRUE(store.ok());
  const Digest digest = DigestOf("precious");
  EXPECT_TRUE(absl::IsDataLoss(store->Write(digest, 8, PiecesOf("presious"))));
  EXPECT_TRUE(absl::IsDataLoss(store->Write(digest, 7, PiecesOf("precious"))));
  EXPECT_TRUE(absl::IsDataLoss(store->Write(digest, 9, PiecesOf("precious"))));
  const auto cut_off = []() -> absl::StatusOr<std::string_view> {
    return absl::CancelledError("the writer left");
  };
  EXPECT_TRUE(absl::IsCancelled(store->Write(digest, 8, cut_off)));
  EXPECT_FALSE(store->Has(digest));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "tmp"));
}

/// As if it had been put `seconds` ago.
void LetAge(const std::string& path, double seconds) {
  namespace fs = std::filesystem;
  const std::chrono::duration<double> age(seconds);
  fs::last_write_time(path,
                      fs::file_time_type::clock::now() -
                          std::chrono::duration_cast<fs::file_time_type::duration>(age));
}

TEST(BlobStore, RemovesOnlyWhatNobodyUsedForLong) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder.Path());
  ASSERT_TRUE(store.ok());
  const Digest digest = *store->Put("text");
  EXPECT_FALSE(store->RemoveUnused(digest, 60.0));
  LetAge(PathOf(folder, digest), 61.0);
  EXPECT_TRUE(store->IsUnused(digest, 60.0));
  EXPECT_TRUE(store->Use(digest));
  EXPECT_FALSE(store->RemoveUnused(digest, 60.0)) << "somebody asked for it";
  LetAge(PathOf(folder, digest), 61.0);
  EXPECT_TRUE(store->Put("text").ok());
  EXPECT_FALSE(store->RemoveUnused(digest, 60.0)) << "somebody put it again";
  LetAge(PathOf(folder, digest), 61.0);
  EXPECT_TRUE(store->Has(digest)) << "looking is no use";
  EXPECT_TRUE(store->RemoveUnused(digest, 60.0));
  EXPECT_FALSE(store->Has(digest));
  EXPECT_FALSE(store->Use(digest));
}

TEST(BlobStore, SharesAFolderThatAnotherHas) {
  const TemporaryFolder folder;
  auto owner = BlobStore::Open(folder.Path());
  ASSERT_TRUE(owner.ok());
  auto guest = BlobStore::Share(folder.Path());
  ASSERT_TRUE(guest.ok()) << guest.status();
  EXPECT_EQ(*guest->Get(*owner->Put("from the owner")), "from the owner");
  EXPECT_EQ(*owner->Get(*guest->Put("from the guest")), "from the guest");
  EXPECT_TRUE(absl::IsNotFound(BlobStore::Share(folder / "tmp").status()));
  EXPECT_TRUE(absl::IsNotFound(BlobStore::Share(folder / "nowhere").status()));
}

TEST(BlobStore, WhoSharesAFolderLeavesItsLinksAlone) {
  const TemporaryFolder folder;
  auto owner = BlobStore::Open(folder / "blobs");
  auto guest = BlobStore::Share(folder / "blobs");
  ASSERT_TRUE(owner.ok() && guest.ok());
  Overwrite(folder / "image.jpg", "pixels");
  const Digest digest = DigestOf("pixels");
  ASSERT_TRUE(owner->LinkFile(digest, folder / "image.jpg").ok());
  Overwrite(folder / "image.jpg", "other pixels, as seen from another machine");
  EXPECT_TRUE(absl::IsNotFound(guest->Get(digest).status()));
  EXPECT_FALSE(guest->Has(digest));
  Overwrite(folder / "image.jpg", "pixels");
  EXPECT_EQ(*owner->Get(digest), "pixels");
}

TEST(BlobStore, WhoIsWritingFindsOutThatTheStoreWasOpenedAnew) {
  const TemporaryFolder folder;
  ASSERT_TRUE(BlobStore::Open(folder.Path()).ok());
  auto guest = BlobStore::Share(folder.Path());
  ASSERT_TRUE(guest.ok());
  bool opened_anew = false;
  const auto open_meanwhile = [&]() -> absl::StatusOr<std::string_view> {
    if (opened_anew) return "";
    opened_anew = true;
    EXPECT_TRUE(BlobStore::Open(folder.Path()).ok());
    return "text";
  };
  EXPECT_TRUE(absl::IsUnavailable(guest->Write(DigestOf("text"), 4, open_meanwhile)));
  EXPECT_TRUE(guest->Write(DigestOf("text"), 4, PiecesOf("text")).ok());
}

TEST(BlobStore, ListsBlobsAndLinksWithTheirSizes) {
  const TemporaryFolder folder;
  auto store = BlobStore::Open(folder / "blobs");
  ASSERT_TRUE(store.ok());
  EXPECT_TRUE(store->List()->empty());
  const Digest text = *store->Put("text");
  Overwrite(folder / "image.jpg", "pixels");
  ASSERT_TRUE(store->LinkFile(DigestOf("pixels"), folder / "image.jpg").ok());
  Overwrite(folder / "blobs/tmp/123.0", "half a blob");
  std::map<Digest, uint64_t> sizes;
  const std::vector<StoredBlob> blobs = *store->List();
  for (const StoredBlob& blob : blobs) sizes[blob.digest] = blob.size_bytes;
  EXPECT_EQ(sizes, (std::map<Digest, uint64_t>{{text, 4}, {DigestOf("pixels"), 0}}));
  EXPECT_TRUE(store->RemoveUnused(DigestOf("pixels"), 0.0));
  EXPECT_FALSE(store->Has(DigestOf("pixels")));
  EXPECT_TRUE(std::filesystem::exists(folder / "image.jpg")) << "the file is not ours";
}

TEST(BlobStore, LeavesNoScratchFilesBehind) {
  const TemporaryFolder folder;
  ASSERT_TRUE(BlobStore::Open(folder.Path()).ok());
  Overwrite(folder / "tmp/123.0", "half a blob of a process that was killed");
  auto store = BlobStore::Open(folder.Path());
  ASSERT_TRUE(store.ok());
  ASSERT_TRUE(store->Put("text").ok());
  EXPECT_TRUE(std::filesystem::is_empty(folder / "tmp"));
}

}  // namespace
}  // namespace orbweave
