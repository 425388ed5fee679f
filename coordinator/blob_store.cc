// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/blob_store.h"

#include <filesystem>

#include "absl/strings/str_cat.h"
#include "coordinator/durable_file.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

bool IsFile(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::string DescribeBlob(const Digest& digest) {
  return absl::StrCat("blob ", digest.ToShortHex());
}

}  // namespace

absl::StatusOr<BlobStore> BlobStore::Open(const std::string& folder) {
  BlobStore store(folder);
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(folder + "/links"));
  ORBWEAVE_RETURN_IF_ERROR(MakeEmptyFolder(store.ScratchDir()));
  return store;
}

std::string BlobStore::BlobPath(const Digest& digest) const {
  const std::string hex = digest.ToHex();
  return absl::StrCat(folder_, "/", hex.substr(0, 2), "/", hex);
}

std::string BlobStore::LinkPath(const Digest& digest) const {
  return absl::StrCat(folder_, "/links/", digest.ToHex());
}

std::string BlobStore::FileOf(const Digest& digest) const {
  const std::string own = BlobPath(digest);
  if (IsFile(own)) return own;
  const absl::StatusOr<std::string> linked = ReadWholeFile(LinkPath(digest));
  return linked.ok() && IsFile(*linked) ? *linked : std::string();
}

void BlobStore::Forget(const Digest& digest) const {
  std::error_code ignored;
  fs::remove(BlobPath(digest), ignored);
  fs::remove(LinkPath(digest), ignored);
}

absl::StatusOr<std::string> BlobStore::Get(const Digest& digest) {
  std::string bytes;
  ORBWEAVE_RETURN_IF_ERROR(Read(digest, [&bytes](std::string_view piece) {
    bytes += piece;
    return absl::OkStatus();
  }));
  return bytes;
}

absl::Status BlobStore::Read(const Digest& digest, const TakePiece& take) {
  const std::string path = FileOf(digest);
  if (path.empty())
    return absl::NotFoundError(absl::StrCat(DescribeBlob(digest), " is not stored"));
  DigestBuilder builder;
  ORBWEAVE_RETURN_IF_ERROR(ReadInPieces(path, [&](std::string_view piece) {
    builder.Add(piece);
    return take(piece);
  }));
  if (builder.Finish() == digest) return absl::OkStatus();
  Forget(digest);
  return absl::DataLossError(
      absl::StrCat(DescribeBlob(digest), " is damaged: ", path, " has other bytes"));
}

absl::StatusOr<Digest> BlobStore::Put(std::string_view bytes) {
  const Digest digest = DigestOf(bytes);
  const std::string path = BlobPath(digest);
  if (IsFile(path)) return digest;
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(fs::path(path).parent_path().string()));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileDurably(ScratchDir(), path, bytes));
  return digest;
}

absl::Status BlobStore::Write(const Digest& digest, uint64_t size_bytes, const NextPiece& next) {
  const std::string path = BlobPath(digest);
  if (IsFile(path)) return absl::OkStatus();
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(fs::path(path).parent_path().string()));
  ORBWEAVE_ASSIGN_OR_RETURN(DurableFile file, DurableFile::Create(ScratchDir()));
  DigestBuilder builder;
  uint64_t received_bytes = 0;
  while (received_bytes <= size_bytes) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string_view piece, next());
    if (piece.empty()) break;
    received_bytes += piece.size();
    builder.Add(piece);
    ORBWEAVE_RETURN_IF_ERROR(file.Append(piece));
  }
  if (received_bytes == size_bytes && builder.Finish() == digest) return file.MoveTo(path);
  return absl::DataLossError(absl::StrCat("not the bytes of ", DescribeBlob(digest)));
}

bool BlobStore::Has(const Digest& digest) const { return !FileOf(digest).empty(); }

bool BlobStore::Verify(const Digest& digest) {
  const std::string path = FileOf(digest);
  if (path.empty()) return false;
  const absl::StatusOr<Digest> actual = DigestOfFile(path);
  if (actual.ok() && *actual == digest) return true;
  if (actual.ok()) Forget(digest);
  return false;
}

absl::Status BlobStore::LinkFile(const Digest& digest, const std::string& path) {
  if (!fs::path(path).is_absolute()) {
    return absl::InvalidArgumentError(absl::StrCat("'", path, "' is no absolute path"));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest actual, DigestOfFile(path));
  if (actual != digest) {
    return absl::DataLossError(
        absl::StrCat(path, " is not ", DescribeBlob(digest), ": it has other bytes"));
  }
  return WriteFileDurably(ScratchDir(), LinkPath(digest), path);
}

}  // namespace orbweave
