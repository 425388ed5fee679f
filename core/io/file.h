// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace orbweave {

/// The whole content of a file. NotFound: no such file; PermissionDenied: may not be read;
/// InvalidArgument: not a regular file; Unavailable: reading failed. Messages name the file.
[[nodiscard]] absl::StatusOr<std::string> ReadFile(const std::string& path);

/// A file that is written piece by piece and takes the place of `path` all at once: a reader, or a
/// crash at any moment, sees either the old content or the whole new one. Errors wait for Commit.
class AtomicFile {
 public:
  /// A temporary file in the same folder, removed again unless Commit succeeds.
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void Append(std::string_view bytes);
  /// Flushes to the disk and renames. Codes of WriteFileAtomically.
  [[nodiscard]] absl::Status Commit();
  /// The same, after the first bytes were written anew: counts that are known last.
  [[nodiscard]] absl::Status CommitWithHead(std::string_view head);

 private:
  void Flush();

  std::string path_;
  std::string temporary_;
  int fd_;
  int error_ = 0;  ///< first errno
  std::string buffer_;
};

/// Replaces `path` by `bytes` so that a reader, or a crash at any moment, sees either the old
/// content or the new one: writes a temporary file in the same folder, flushes it to the disk and
/// renames it. ResourceExhausted: the disk is full; PermissionDenied or NotFound: the folder cannot
/// be written; Unavailable otherwise. On failure the temporary file is removed and `path` is as
/// before.
[[nodiscard]] absl::Status WriteFileAtomically(const std::string& path, std::string_view bytes);

/// Makes `folder` and its parents, and proves with a probe file that it can be written. Codes as
/// for WriteFileAtomically; FailedPrecondition: something that is no folder is in the way.
[[nodiscard]] absl::Status EnsureWritableFolder(const std::string& folder);

}  // namespace orbweave
