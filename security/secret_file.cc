// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/secret_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/file_descriptor.h"

namespace orbweave {
namespace {

constexpr off_t kLargest_bytes = off_t{1} << 20;

absl::Status SystemError(const char* action, const std::string& path) {
  return absl::ErrnoToStatus(errno, absl::StrCat("cannot ", action, " ", path));
}

bool WriteWhole(const std::string& path, std::string_view bytes) {
  const FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!file.IsOpen()) return false;
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return ::fsync(file.get()) == 0;
}

}  // namespace

absl::Status WriteSecretFile(const std::string& path, std::string_view bytes) {
  const std::string fresh = absl::StrCat(path, ".new");
  ::unlink(fresh.c_str());  // of a run that was killed here
  if (WriteWhole(fresh, bytes) && std::rename(fresh.c_str(), path.c_str()) == 0)
    return absl::OkStatus();
  absl::Status status = SystemError("write", path);
  ::unlink(fresh.c_str());
  return status;
}

absl::StatusOr<std::string> ReadSecretFile(const std::string& path) {
  // A pipe must not block us.
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat info {};
  if (!file.IsOpen() || ::fstat(file.get(), &info) != 0) return SystemError("read", path);
  if (!S_ISREG(info.st_mode) || info.st_size > kLargest_bytes)
    return absl::InvalidArgumentError(absl::StrCat(path, " is no file of keys"));
  if ((info.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    return absl::PermissionDeniedError(
        absl::StrCat(path, " is open to others: chmod 600 it, and think about who has read it"));
  }
  std::string bytes(static_cast<size_t>(info.st_size), '\0');
  const ssize_t got = ::read(file.get(), bytes.data(), bytes.size());
  if (got < 0) return SystemError("read", path);
  bytes.resize(static_cast<size_t>(got));
  return bytes;
}

}  // namespace orbweave
