// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/scratch_tier.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "absl/strings/str_cat.h"
#include "core/base/file_descriptor.h"
#include "core/base/status.h"
#include "core/storage/durable_file.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// A file that grows beside a reading, as long as the disk takes it.
class Copy {
 public:
  explicit Copy(std::string path)
      : path_(std::move(path)),
        file_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600)) {}
  ~Copy() { ::unlink(path_.c_str()); }  // unless it was moved
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;

  void Append(std::string_view piece) {
    while (!piece.empty() && file_.IsOpen()) {
      const ssize_t written = ::write(file_.get(), piece.data(), piece.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) {
        file_ = {};
        return;
      }
      piece.remove_prefix(static_cast<size_t>(written));
      size_bytes_ += static_cast<uint64_t>(written);
    }
  }
  /// Whether all of it is there.
  [[nodiscard]] bool IsWhole() const { return file_.IsOpen(); }
  [[nodiscard]] uint64_t size_bytes() const { return size_bytes_; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  const std::string path_;
  FileDescriptor file_;
  uint64_t size_bytes_ = 0;
};

}  // namespace

absl::StatusOr<std::unique_ptr<ScratchTier>> ScratchTier::Make(BlobAccess& source,
                                                               const std::string& folder,
                                                               uint64_t capacity_bytes) {
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(folder));
  std::string own = folder + "/orbweave-scratch-XXXXXX";
  if (::mkdtemp(own.data()) == nullptr) {
    return absl::PermissionDeniedError(
        absl::StrCat("cannot make a folder in ", folder, ": ", std::strerror(errno)));
  }
  return std::unique_ptr<ScratchTier>(new ScratchTier(source, own, capacity_bytes));
}

ScratchTier::~ScratchTier() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string ScratchTier::PathOf(const Digest& digest) const {
  return absl::StrCat(folder_, "/", digest.ToHex());
}

absl::StatusOr<std::string> ScratchTier::Get(const Digest& digest) {
  std::string bytes;
  ORBWEAVE_RETURN_IF_ERROR(Read(digest, [&bytes](std::string_view piece) {
    bytes += piece;
    return absl::OkStatus();
  }));
  return bytes;
}

absl::StatusOr<Digest> ScratchTier::Put(std::string_view bytes) { return source_.Put(bytes); }

absl::Status ScratchTier::Write(const Digest& digest, uint64_t size_bytes, const NextPiece& next) {
  return source_.Write(digest, size_bytes, next);
}

absl::Status ScratchTier::Read(const Digest& digest, const TakePiece& take) {
  const absl::Status kept = ReadKept(digest, take);
  if (!absl::IsNotFound(kept)) return kept;
  uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++files_;
  }
  Copy copy(absl::StrCat(folder_, "/", number, ".part"));
  ORBWEAVE_RETURN_IF_ERROR(source_.Read(digest, [&](std::string_view piece) {
    copy.Append(piece);
    return take(piece);
  }));
  if (copy.IsWhole()) Keep(digest, copy.size_bytes(), copy.path());
  return absl::OkStatus();
}

int ScratchTier::Open(const Digest& digest) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(digest);
  if (place == places_.end()) return -1;
  kept_.splice(kept_.begin(), kept_, place->second);
  return ::open(PathOf(digest).c_str(), O_RDONLY | O_CLOEXEC);
}

absl::Status ScratchTier::ReadKept(const Digest& digest, const TakePiece& take) {
  const FileDescriptor file(Open(digest));  // which stays when others take its room
  if (!file.IsOpen()) {
    Drop(digest);  // somebody removed it
    return absl::NotFoundError("not kept");
  }
  DigestBuilder builder;
  std::string piece(kPieceBytes, '\0');
  while (true) {
    const ssize_t got = ::read(file.get(), piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) break;
    if (got == 0) {
      if (builder.Finish() == digest) return absl::OkStatus();
      break;
    }
    const std::string_view read(piece.data(), static_cast<size_t>(got));
    builder.Add(read);
    ORBWEAVE_RETURN_IF_ERROR(take(read));
  }
  Drop(digest);
  return absl::UnavailableError(
      absl::StrCat("the copy of blob ", digest.ToShortHex(), " in ", folder_, " was damaged"));
}

void ScratchTier::Keep(const Digest& digest, uint64_t size_bytes, const std::string& from) {
  const std::lock_guard lock(mutex_);
  if (size_bytes > capacity_bytes_ || places_.contains(digest)) return;
  if (::rename(from.c_str(), PathOf(digest).c_str()) != 0) return;
  kept_.push_front({digest, size_bytes});
  places_[digest] = kept_.begin();
  size_bytes_ += size_bytes;
  while (size_bytes_ > capacity_bytes_) {
    const Kept& last = kept_.back();
    ::unlink(PathOf(last.digest).c_str());
    size_bytes_ -= last.size_bytes;
    places_.erase(last.digest);
    kept_.pop_back();
  }
}

void ScratchTier::Drop(const Digest& digest) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(digest);
  if (place == places_.end()) return;
  ::unlink(PathOf(digest).c_str());
  size_bytes_ -= place->second->size_bytes;
  kept_.erase(place->second);
  places_.erase(place);
}

}  // namespace orbweave
