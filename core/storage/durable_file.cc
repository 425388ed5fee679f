// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/storage/durable_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault_point.h"

namespace orbweave {
namespace {

absl::Status SystemError(int error, std::string_view doing, const std::string& path) {
  const std::string message =
      absl::StrCat(std::string(doing), " ", path, ": ", std::strerror(error));
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return absl::ResourceExhaustedError(message);
    case EACCES:
    case EPERM:
    case EROFS:
      return absl::PermissionDeniedError(message);
    case ENOENT:
      return absl::NotFoundError(message);
    default:
      return absl::UnavailableError(message);
  }
}

/// A file or folder that is gone is no answer to who writes it.
absl::Status WriteError(int error, std::string_view doing, const std::string& path) {
  const absl::Status status = SystemError(error, doing, path);
  return absl::IsNotFound(status) ? absl::UnavailableError(status.message()) : status;
}

absl::Status SyncFolder(const std::string& path) {
  const FileDescriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.IsOpen() || ::fsync(folder.get()) != 0)
    return SystemError(errno, "cannot sync", path);
  return absl::OkStatus();
}

absl::Status SyncAndRename(const FileDescriptor& file,
                           const std::string& from,
                           const std::string& to) {
  if (::fsync(file.get()) != 0) return WriteError(errno, "cannot write", to);
  FaultPoint("rename", FaultSide::kBefore);
  if (::rename(from.c_str(), to.c_str()) != 0) return WriteError(errno, "cannot write", to);
  FaultPoint("rename", FaultSide::kAfter);
  return absl::OkStatus();
}

}  // namespace

std::string ScratchPath(const std::string& scratch_dir) {
  static const uint64_t kProcess = [] {
    std::random_device device;
    return uint64_t{device()} << 32 | device();
  }();
  static std::atomic<uint64_t> counter{0};
  return absl::StrCat(scratch_dir, "/", absl::Hex(kProcess), ".", counter.fetch_add(1));
}

absl::StatusOr<DurableFile> DurableFile::Create(const std::string& scratch_dir) {
  std::string path = ScratchPath(scratch_dir);
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (!file.IsOpen()) return WriteError(errno, "cannot create", path);
  return DurableFile(std::move(path), std::move(file));
}

DurableFile::~DurableFile() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

DurableFile::DurableFile(DurableFile&& other) noexcept
    : path_(std::exchange(other.path_, {})), file_(std::move(other.file_)) {}

absl::Status DurableFile::Append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return SystemError(errno, "cannot write", path_);
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return absl::OkStatus();
}

absl::Status DurableFile::MoveTo(const std::string& path) {
  ORBWEAVE_RETURN_IF_ERROR(SyncAndRename(file_, path_, path));
  path_.clear();
  return SyncFolder(std::filesystem::path(path).parent_path().string());
}

absl::Status MoveFileDurably(const std::string& from, const std::string& to) {
  const FileDescriptor file(::open(from.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.IsOpen()) return SystemError(errno, "cannot open", from);
  ORBWEAVE_RETURN_IF_ERROR(SyncAndRename(file, from, to));
  return SyncFolder(std::filesystem::path(to).parent_path().string());
}

absl::Status WriteFileDurably(const std::string& scratch_dir,
                              const std::string& path,
                              std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(DurableFile file, DurableFile::Create(scratch_dir));
  ORBWEAVE_RETURN_IF_ERROR(file.Append(bytes));
  return file.MoveTo(path);
}

absl::Status ReadInPieces(const std::string& path, const TakePiece& take) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.IsOpen()) return SystemError(errno, "cannot open", path);
  std::string piece(kPieceBytes, '\0');
  while (true) {
    const ssize_t got = ::read(file.get(), piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return SystemError(errno, "cannot read", path);
    if (got == 0) return absl::OkStatus();
    ORBWEAVE_RETURN_IF_ERROR(take(std::string_view(piece.data(), static_cast<size_t>(got))));
  }
}

absl::StatusOr<std::string> ReadWholeFile(const std::string& path) {
  std::string bytes;
  ORBWEAVE_RETURN_IF_ERROR(ReadInPieces(path, [&bytes](std::string_view piece) {
    bytes += piece;
    return absl::OkStatus();
  }));
  return bytes;
}

absl::Status MakeFolder(const std::string& path) {
  std::error_code error;
  const bool is_new = std::filesystem::create_directories(path, error);
  if (error) return SystemError(error.value(), "cannot create folder", path);
  return is_new ? SyncFolder(std::filesystem::absolute(path).parent_path().string())
                : absl::OkStatus();
}

absl::Status MakeEmptyFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::remove_all(path, error);
  if (error) return SystemError(error.value(), "cannot empty folder", path);
  return MakeFolder(path);
}

}  // namespace orbweave
