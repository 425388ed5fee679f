// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/file_roots.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "absl/strings/str_cat.h"
#include "core/base/file_descriptor.h"

namespace orbweave {
namespace {

absl::Status OpenError(int error, const std::string& root, const std::string& relative) {
  const std::string file = absl::StrCat(relative, " beneath root ", root);
  switch (error) {
    case EXDEV:
    case ELOOP:
      return absl::PermissionDeniedError(absl::StrCat(file, " leads out of the root"));
    default:
      return absl::ErrnoToStatus(error, absl::StrCat("cannot open ", file));
  }
}

}  // namespace

absl::StatusOr<std::string> ResolveBeneath(const FileRoots& roots,
                                           const std::string& root,
                                           const std::string& relative) {
  const auto folder = roots.find(root);
  if (folder == roots.end())
    return absl::NotFoundError(absl::StrCat("this coordinator has no root '", root, "'"));
  if (relative.empty() || relative.find('\0') != std::string::npos)
    return absl::InvalidArgumentError("this is no path");
  const FileDescriptor top(::open(folder->second.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!top.IsOpen()) return OpenError(errno, root, ".");
  open_how how{};
  how.flags = O_RDONLY | O_NONBLOCK | O_CLOEXEC;  // a pipe must not block us
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  const FileDescriptor file(
      static_cast<int>(::syscall(SYS_openat2, top.get(), relative.c_str(), &how, sizeof(how))));
  if (!file.IsOpen()) return OpenError(errno, root, relative);
  struct stat info {};
  if (::fstat(file.get(), &info) != 0 || !S_ISREG(info.st_mode)) {
    return absl::InvalidArgumentError(
        absl::StrCat(relative, " beneath root ", root, " is no regular file"));
  }
  std::error_code error;
  const auto path =
      std::filesystem::read_symlink(absl::StrCat("/proc/self/fd/", file.get()), error);
  if (error) return OpenError(error.value(), root, relative);
  return path.string();
}

}  // namespace orbweave
