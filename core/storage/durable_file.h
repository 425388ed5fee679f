// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "core/base/file_descriptor.h"
#include "core/base/status.h"
#include "core/pipeline/blob_access.h"

namespace orbweave {

/// A file in the making. A crash at any moment leaves the old file under its name, none, or the
/// whole new one: it is a temporary file until MoveTo, and removed when that does not come. Errors
/// of all: ResourceExhausted: disk full. PermissionDenied, Unavailable: the system's reason, with
/// the path; Unavailable also when somebody emptied `scratch_dir` meanwhile.
class DurableFile {
 public:
  /// `scratch_dir` is on the file system of the name it is to have; others may use it too.
  [[nodiscard]] static absl::StatusOr<DurableFile> Create(const std::string& scratch_dir);
  ~DurableFile();
  DurableFile(DurableFile&& other) noexcept;
  DurableFile& operator=(DurableFile&& other) = delete;

  [[nodiscard]] absl::Status Append(std::string_view bytes);
  /// The last call: fsync, rename, fsync of the folder.
  [[nodiscard]] absl::Status MoveTo(const std::string& path);

 private:
  DurableFile(std::string path, FileDescriptor file)
      : path_(std::move(path)), file_(std::move(file)) {}

  std::string path_;  ///< empty: it has its name
  FileDescriptor file_;
};

/// A path in `scratch_dir` that nobody else has, on no machine.
[[nodiscard]] std::string ScratchPath(const std::string& scratch_dir);

/// A DurableFile of these bytes.
[[nodiscard]] absl::Status WriteFileDurably(const std::string& scratch_dir,
                                            const std::string& path,
                                            std::string_view bytes);

/// Gives a file that somebody else wrote beside `to` that name: durable when this returns OK; a
/// crash leaves the old file or the whole new one. Errors as of DurableFile.
[[nodiscard]] absl::Status MoveFileDurably(const std::string& from, const std::string& to);

/// The file in pieces. NotFound when there is none; errors of `take`.
[[nodiscard]] absl::Status ReadInPieces(const std::string& path, const TakePiece& take);

/// The whole file. NotFound when there is none.
[[nodiscard]] absl::StatusOr<std::string> ReadWholeFile(const std::string& path);

/// Creates a folder and those above it, unless it is there.
[[nodiscard]] absl::Status MakeFolder(const std::string& path);

/// Creates `path`, or removes every file in it.
[[nodiscard]] absl::Status MakeEmptyFolder(const std::string& path);

}  // namespace orbweave
