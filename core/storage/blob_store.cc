// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/storage/blob_store.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <map>

#include "absl/strings/str_cat.h"
#include "core/base/fault_point.h"
#include "core/storage/durable_file.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

bool IsFile(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool IsFolder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool WasUsed(const std::string& path, double within_s) {
  const auto since = fs::file_time_type::clock::now() - std::chrono::duration<double>(within_s);
  std::error_code gone;
  const fs::file_time_type used = fs::last_write_time(path, gone);
  return !gone && used > since;
}

std::string DescribeBlob(const Digest& digest) {
  return absl::StrCat("blob ", digest.ToShortHex());
}

}  // namespace

absl::StatusOr<BlobStore> BlobStore::Open(const std::string& folder) {
  BlobStore store(folder, true);
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(folder + "/links"));
  ORBWEAVE_RETURN_IF_ERROR(MakeEmptyFolder(store.ScratchDir()));
  return store;
}

absl::StatusOr<BlobStore> BlobStore::Share(const std::string& folder) {
  BlobStore store(folder, false);
  if (IsFolder(folder + "/links") && IsFolder(store.ScratchDir())) return store;
  return absl::NotFoundError(absl::StrCat(folder, " is not the blob folder of a coordinator"));
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
  if (!follows_links_) return {};
  const std::string linked = LinkOf(digest);
  return IsFile(linked) ? linked : std::string();
}

std::string BlobStore::LinkOf(const Digest& digest) const {
  const absl::StatusOr<std::string> linked = ReadWholeFile(LinkPath(digest));
  return linked.ok() ? *linked : std::string();
}

void BlobStore::Forget(const Digest& digest) const {
  std::error_code ignored;
  fs::remove(BlobPath(digest), ignored);
  if (follows_links_) fs::remove(LinkPath(digest), ignored);
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
  FaultPoint("get", FaultSide::kBefore);
  const std::string path = FileOf(digest);
  if (path.empty()) return NotStored(digest);
  DigestBuilder builder;
  ORBWEAVE_RETURN_IF_ERROR(ReadInPieces(path, [&](std::string_view piece) {
    builder.Add(piece);
    return take(piece);
  }));
  if (builder.Finish() == digest) return absl::OkStatus();
  // A link is kept, so that whoever asks again is told of the file too.
  const bool is_own = path == BlobPath(digest);
  if (is_own) Forget(digest);
  return absl::DataLossError(absl::StrCat(
      DescribeBlob(digest),
      " is damaged: ",
      path,
      is_own ? " has other bytes" : " was changed after the job was submitted; submit it again"));
}

absl::Status BlobStore::NotStored(const Digest& digest) const {
  const std::string linked = follows_links_ ? LinkOf(digest) : std::string();
  return absl::NotFoundError(absl::StrCat(DescribeBlob(digest),
                                          " is not stored",
                                          linked.empty() ? "" : ": it was the file ",
                                          linked,
                                          linked.empty() ? "" : ", which is gone"));
}

absl::StatusOr<Digest> BlobStore::Put(std::string_view bytes) {
  const Digest digest = DigestOf(bytes);
  const std::string path = BlobPath(digest);
  if (Verify(digest) && Use(digest)) return digest;
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(fs::path(path).parent_path().string()));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileDurably(ScratchDir(), path, bytes));
  return digest;
}

absl::Status BlobStore::Write(const Digest& digest, uint64_t size_bytes, const NextPiece& next) {
  const std::string path = BlobPath(digest);
  if (Verify(digest) && Use(digest)) return absl::OkStatus();
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

bool BlobStore::Use(const Digest& digest) const {
  const bool is_own = ::utimensat(AT_FDCWD, BlobPath(digest).c_str(), nullptr, 0) == 0;
  if (!is_own) ::utimensat(AT_FDCWD, LinkPath(digest).c_str(), nullptr, 0);
  return Has(digest);
}

absl::StatusOr<std::vector<StoredBlob>> BlobStore::List() const {
  std::map<Digest, uint64_t> sizes;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder_, error), end; !error && it != end;
       it.increment(error)) {
    const absl::StatusOr<Digest> digest = Digest::FromHex(it->path().filename().string());
    std::error_code gone;
    if (!digest.ok() || !it->is_regular_file(gone)) continue;
    const bool is_link = it->path().parent_path().filename() == "links";
    const uint64_t size_bytes = is_link ? 0 : it->file_size(gone);
    if (!gone) sizes[*digest] += size_bytes;
  }
  if (error)
    return absl::UnavailableError(absl::StrCat("cannot read ", folder_, ": ", error.message()));
  std::vector<StoredBlob> blobs;
  for (const auto& [digest, size_bytes] : sizes) blobs.push_back({digest, size_bytes});
  return blobs;
}

bool BlobStore::IsUnused(const Digest& digest, double unused_s) const {
  return !WasUsed(BlobPath(digest), unused_s) && !WasUsed(LinkPath(digest), unused_s);
}

bool BlobStore::RemoveUnused(const Digest& digest, double unused_s) {
  if (!IsUnused(digest, unused_s)) return false;
  const bool removed = RemoveFileUnused(BlobPath(digest), unused_s);
  return RemoveFileUnused(LinkPath(digest), unused_s) && removed;
}

/// Between looking when it was used and removing it, anybody may use it, also another process. So
/// it is put aside first: who uses it from then on finds nothing, and who did before is seen now.
bool BlobStore::RemoveFileUnused(const std::string& path, double unused_s) {
  const std::string aside = ScratchPath(ScratchDir());
  std::error_code gone;
  fs::rename(path, aside, gone);
  if (gone) return true;
  std::error_code ignored;
  if (!WasUsed(aside, unused_s)) return fs::remove(aside, ignored);
  fs::rename(aside, path, ignored);
  return false;
}

bool BlobStore::Verify(const Digest& digest) {
  const std::string path = FileOf(digest);
  if (path.empty()) return false;
  const absl::StatusOr<Digest> actual = DigestOfFile(path);
  if (actual.ok() && *actual == digest) return true;
  if (actual.ok()) Forget(digest);
  return false;
}

absl::StatusOr<std::vector<bool>> BlobStore::StatBlobs(const std::vector<Digest>& digests) {
  std::vector<bool> stored;
  for (const Digest& digest : digests) stored.push_back(Use(digest));
  return stored;
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
  return NotePlace(digest, path);
}

absl::Status BlobStore::NotePlace(const Digest& digest, const std::string& place) {
  return WriteFileDurably(ScratchDir(), LinkPath(digest), place);
}

}  // namespace orbweave
