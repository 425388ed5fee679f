// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/durable_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "absl/strings/str_cat.h"
#include "core/base/file_descriptor.h"

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

absl::Status WriteAndSync(const std::string& path, std::string_view bytes) {
  const FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!file.IsOpen()) return SystemError(errno, "cannot create", path);
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return SystemError(errno, "cannot write", path);
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  if (::fsync(file.get()) != 0) return SystemError(errno, "cannot write", path);
  return absl::OkStatus();
}

absl::Status SyncFolder(const std::string& path) {
  const FileDescriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.IsOpen() || ::fsync(folder.get()) != 0)
    return SystemError(errno, "cannot sync", path);
  return absl::OkStatus();
}

}  // namespace

absl::Status WriteFileDurably(const std::string& scratch_dir,
                              const std::string& path,
                              std::string_view bytes) {
  static std::atomic<uint64_t> counter{0};
  const std::string scratch = absl::StrCat(scratch_dir, "/", ::getpid(), ".", counter.fetch_add(1));
  absl::Status status = WriteAndSync(scratch, bytes);
  if (status.ok() && ::rename(scratch.c_str(), path.c_str()) != 0) {
    status = SystemError(errno, "cannot write", path);
  }
  if (!status.ok()) {
    ::unlink(scratch.c_str());
    return status;
  }
  return SyncFolder(std::filesystem::path(path).parent_path().string());
}

absl::StatusOr<std::string> ReadWholeFile(const std::string& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.IsOpen()) return SystemError(errno, "cannot open", path);
  const off_t size = ::lseek(file.get(), 0, SEEK_END);
  if (size < 0) return SystemError(errno, "cannot read", path);
  std::string bytes(static_cast<size_t>(size), '\0');
  size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::pread(
        file.get(), bytes.data() + filled, bytes.size() - filled, static_cast<off_t>(filled));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return SystemError(errno, "cannot read", path);
    if (got == 0) break;
    filled += static_cast<size_t>(got);
  }
  bytes.resize(filled);
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
