// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/base/file_descriptor.h"
#include "core/base/status.h"

namespace orbweave {

/// Bytes that never change. Large ones lie in a sealed memory file, which another process can be
/// handed without copying them; small ones, and all where the system gives no memory file, lie on
/// the heap. Copies share them. Thread-safe.
class SharedBytes {
 public:
  /// The least size of a memory file: below it, sending the bytes costs less than a file.
  static constexpr size_t kLeastFileBytes = size_t{128} << 10;

  SharedBytes() = default;
  [[nodiscard]] static SharedBytes Of(std::string bytes);
  /// Copies `bytes`.
  [[nodiscard]] static SharedBytes CopyOf(std::string_view bytes);
  /// The content of a memory file that another process made. InvalidArgument unless it is sealed
  /// against every change; ResourceExhausted: it cannot be mapped.
  [[nodiscard]] static absl::StatusOr<SharedBytes> FromFile(FileDescriptor file);

  /// Valid as long as this or a copy of it lives.
  [[nodiscard]] std::string_view View() const;
  /// Of the memory file; negative: the bytes lie on the heap.
  [[nodiscard]] int descriptor() const;

 private:
  class File;
  explicit SharedBytes(std::shared_ptr<const File> file) : file_(std::move(file)) {}

  std::shared_ptr<const File> file_;
  std::shared_ptr<const std::string> text_;
};

/// Gathers bytes in pieces, however many come, without ever holding them twice.
class SharedBytesBuilder {
 public:
  /// ResourceExhausted: the system has no room for them.
  [[nodiscard]] absl::Status Append(std::string_view piece);
  /// All that was appended. The last call.
  [[nodiscard]] absl::StatusOr<SharedBytes> Finish();

 private:
  std::string text_;     ///< while there is no file
  FileDescriptor file_;  ///< from SharedBytes::kLeastFileBytes on, where the system gives one
};

}  // namespace orbweave
