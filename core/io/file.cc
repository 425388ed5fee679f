// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// What `error` (an errno) means for somebody who wanted to `action` ("write") `path`.
absl::Status StatusFromErrno(int error, const char* action, const std::string& path) {
  const std::string what = absl::StrCat("cannot ", action, " ", path, ": ");
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return absl::ResourceExhaustedError(
          absl::StrCat(what, "disk full; free some space and run again, finished work is kept"));
    case EACCES:
    case EPERM:
    case EROFS:
      return absl::PermissionDeniedError(
          absl::StrCat(what, "no permission; choose another folder or change its permissions"));
    case ENOENT:
      return absl::NotFoundError(absl::StrCat(what, "no such file or folder"));
    case ENOTDIR:
    case EEXIST:
    case EISDIR:
      return absl::FailedPreconditionError(
          absl::StrCat(what, std::strerror(error), "; remove what is in the way"));
    default:
      return absl::UnavailableError(absl::StrCat(what, std::strerror(error)));
  }
}

/// A file descriptor that is closed at the end of its scope.
class OpenFile {
 public:
  OpenFile(const std::string& path, int flags)
      : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  ~OpenFile() {
    if (fd_ >= 0) ::close(fd_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  [[nodiscard]] bool ok() const { return fd_ >= 0; }
  [[nodiscard]] int fd() const { return fd_; }
  /// 0, or the errno: some file systems report a full disk only here.
  int Close() {
    const int result = ::close(fd_);
    fd_ = -1;
    return result == 0 ? 0 : errno;
  }

 private:
  int fd_;
};

/// 0, or the errno.
int WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), std::min<size_t>(bytes.size(), 1 << 30));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return 0;
}

/// 0, or the errno; some file systems have no fsync.
int FlushToDisk(int fd) {
  return ::fsync(fd) == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
}

int WriteAndFlush(const std::string& path, std::string_view bytes) {
  OpenFile file(path, O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.ok()) return errno;
  if (const int error = WriteAll(file.fd(), bytes); error != 0) return error;
  if (const int error = FlushToDisk(file.fd()); error != 0) return error;
  return file.Close();
}

}  // namespace

absl::StatusOr<std::string> ReadFile(const std::string& path) {
  OpenFile file(path, O_RDONLY | O_NONBLOCK);  // a pipe must not block us
  if (!file.ok()) return StatusFromErrno(errno, "read", path);
  struct stat info {};
  if (::fstat(file.fd(), &info) != 0) return StatusFromErrno(errno, "read", path);
  if (!S_ISREG(info.st_mode)) {
    return absl::InvalidArgumentError(absl::StrCat("cannot read ", path, ": it is not a file"));
  }
  std::string bytes(static_cast<size_t>(info.st_size), '\0');
  size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t got = ::read(file.fd(), bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return StatusFromErrno(errno, "read", path);
    if (got == 0) break;
    size += static_cast<size_t>(got);
  }
  bytes.resize(size);
  return bytes;
}

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)),
      temporary_(absl::StrCat(path_, ".tmp", ::getpid())),
      fd_(::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
  if (fd_ < 0) error_ = errno;
}

AtomicFile::~AtomicFile() {
  if (fd_ < 0) return;
  ::close(fd_);
  ::unlink(temporary_.c_str());
}

void AtomicFile::Append(std::string_view bytes) {
  constexpr size_t kEnough = 1 << 20;
  buffer_.append(bytes);
  if (buffer_.size() >= kEnough) Flush();
}

void AtomicFile::Flush() {
  if (error_ == 0) error_ = WriteAll(fd_, buffer_);
  buffer_.clear();
}

absl::Status AtomicFile::Commit() {
  Flush();
  if (error_ == 0) error_ = FlushToDisk(fd_);
  if (error_ == 0 && ::close(fd_) != 0) error_ = errno;
  if (error_ == 0 && std::rename(temporary_.c_str(), path_.c_str()) != 0) error_ = errno;
  if (error_ != 0) return StatusFromErrno(error_, "write", path_);
  fd_ = -1;
  return absl::OkStatus();
}

absl::Status AtomicFile::CommitWithHead(std::string_view head) {
  Flush();
  if (error_ == 0 && ::lseek(fd_, 0, SEEK_SET) != 0) error_ = errno;
  if (error_ == 0) error_ = WriteAll(fd_, head);
  return Commit();
}

absl::Status WriteFileAtomically(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.Append(bytes);
  return file.Commit();
}

absl::Status EnsureWritableFolder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return StatusFromErrno(error.value(), "make folder", folder);
  const std::string probe = absl::StrCat(folder, "/.orbweave_probe", ::getpid());
  const int failed = WriteAndFlush(probe, "?");
  ::unlink(probe.c_str());
  return failed == 0 ? absl::OkStatus() : StatusFromErrno(failed, "write into", folder);
}

}  // namespace orbweave
