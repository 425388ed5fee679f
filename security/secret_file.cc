// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/secret_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string>
#include <vector>

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

/// The groups of this process.
bool IsOurGroup(gid_t group) {
  if (group == ::getegid()) return true;
  std::vector<gid_t> groups(static_cast<size_t>(std::max(0, ::getgroups(0, nullptr))));
  const int found = ::getgroups(static_cast<int>(groups.size()), groups.data());
  groups.resize(static_cast<size_t>(std::max(0, found)));
  return std::ranges::find(groups, group) != groups.end();
}

/// Whether nobody may read it but its owner, or root and a group of ours.
bool IsSecret(const struct stat& info) {
  const mode_t others = info.st_mode & (S_IRWXG | S_IRWXO);
  if (others == 0) return true;
  return others == S_IRGRP && info.st_uid == 0 && ::geteuid() != 0 && IsOurGroup(info.st_gid);
}

template <typename Check>
absl::StatusOr<std::string> Read(const std::string& path, Check&& check) {
  // A pipe must not block us.
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat info {};
  if (!file.IsOpen() || ::fstat(file.get(), &info) != 0) return SystemError("read", path);
  if (!S_ISREG(info.st_mode) || info.st_size > kLargest_bytes)
    return absl::InvalidArgumentError(absl::StrCat(path, " is no file of keys"));
  ORBWEAVE_RETURN_IF_ERROR(check(info));
  std::string bytes(static_cast<size_t>(info.st_size), '\0');
  const ssize_t got = ::read(file.get(), bytes.data(), bytes.size());
  if (got < 0) return SystemError("read", path);
  bytes.resize(static_cast<size_t>(got));
  return bytes;
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
  return Read(path, [&path](const struct stat& info) {
    if (IsSecret(info)) return absl::OkStatus();
    return absl::PermissionDeniedError(
        absl::StrCat(path, " is open to others: chmod 600 it, and think about who has read it"));
  });
}

absl::StatusOr<std::string> ReadTrustedFile(const std::string& path) {
  return Read(path, [&path](const struct stat& info) {
    if ((info.st_mode & (S_IWGRP | S_IWOTH)) == 0) return absl::OkStatus();
    return absl::PermissionDeniedError(
        absl::StrCat(path, " can be changed by others: chmod go-w it, and look who did"));
  });
}

}  // namespace orbweave
