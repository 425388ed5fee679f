// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/shared_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL;

bool WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return true;
}

FileDescriptor MakeMemoryFile() {
  return FileDescriptor(::memfd_create("orbweave-blob", MFD_CLOEXEC | MFD_ALLOW_SEALING));
}

bool Seal(const FileDescriptor& file) { return ::fcntl(file.get(), F_ADD_SEALS, kSeals) == 0; }

/// Nothing when the system has no room for it.
std::optional<FileDescriptor> WriteMemoryFile(std::string_view bytes) {
  FileDescriptor file = MakeMemoryFile();
  if (!file.IsOpen() || !WriteAll(file.get(), bytes) || !Seal(file)) return std::nullopt;
  return file;
}

}  // namespace

class SharedBytes::File {
 public:
  /// A mapping of `size` bytes of `file`.
  File(FileDescriptor file, void* data, size_t size)
      : file_(std::move(file)), data_(data), size_(size) {}
  ~File() {
    if (size_ > 0) ::munmap(data_, size_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  [[nodiscard]] std::string_view View() const { return {static_cast<const char*>(data_), size_}; }
  [[nodiscard]] int descriptor() const { return file_.get(); }

 private:
  FileDescriptor file_;
  void* data_;
  size_t size_;
};

absl::StatusOr<SharedBytes> SharedBytes::FromFile(FileDescriptor file) {
  struct stat info {};
  const int seals = ::fcntl(file.get(), F_GET_SEALS);
  if (seals < 0 || (seals & kSeals) != kSeals || ::fstat(file.get(), &info) != 0)
    return absl::InvalidArgumentError("bytes in a file that may still change");
  const auto size = static_cast<size_t>(info.st_size);
  if (size == 0) return SharedBytes();
  void* data = ::mmap(nullptr, size, PROT_READ, MAP_SHARED | MAP_POPULATE, file.get(), 0);
  if (data == MAP_FAILED) {
    return absl::ResourceExhaustedError(
        absl::StrCat("cannot map ", size, " bytes: ", std::strerror(errno)));
  }
  return SharedBytes(std::make_shared<const File>(std::move(file), data, size));
}

SharedBytes SharedBytes::Of(std::string bytes) {
  if (bytes.size() >= kLeastFileBytes) return CopyOf(bytes);
  SharedBytes shared;
  shared.text_ = std::make_shared<const std::string>(std::move(bytes));
  return shared;
}

SharedBytes SharedBytes::CopyOf(std::string_view bytes) {
  if (bytes.size() >= kLeastFileBytes) {
    std::optional<FileDescriptor> file = WriteMemoryFile(bytes);
    if (file) {
      absl::StatusOr<SharedBytes> mapped = FromFile(*std::move(file));
      if (mapped.ok()) return *std::move(mapped);
    }
  }
  SharedBytes shared;
  shared.text_ = std::make_shared<const std::string>(bytes);
  return shared;
}

std::string_view SharedBytes::View() const {
  if (file_) return file_->View();
  return text_ ? std::string_view(*text_) : std::string_view();
}

int SharedBytes::descriptor() const { return file_ ? file_->descriptor() : -1; }

absl::Status SharedBytesBuilder::Append(std::string_view piece) {
  if (!file_.IsOpen()) {
    text_ += piece;
    if (text_.size() < SharedBytes::kLeastFileBytes) return absl::OkStatus();
    file_ = MakeMemoryFile();
    if (!file_.IsOpen()) return absl::OkStatus();
    piece = text_;
  }
  if (!WriteAll(file_.get(), piece))
    return absl::ResourceExhaustedError("no memory left for the bytes of a blob");
  std::string().swap(text_);
  return absl::OkStatus();
}

absl::StatusOr<SharedBytes> SharedBytesBuilder::Finish() {
  if (!file_.IsOpen()) return SharedBytes::Of(std::move(text_));
  if (!Seal(file_)) return absl::ResourceExhaustedError("cannot seal the bytes of a blob");
  return SharedBytes::FromFile(std::move(file_));
}

}  // namespace orbweave
