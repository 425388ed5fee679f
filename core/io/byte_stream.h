// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace orbweave {

static_assert(std::endian::native == std::endian::little, "binary files are little-endian");

/// Appends plain numbers to a string of bytes, little-endian, without padding.
class ByteWriter {
 public:
  template <typename T>
  ByteWriter& Put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    bytes_.append(bytes, sizeof(T));
    return *this;
  }
  ByteWriter& PutText(std::string_view text) {
    bytes_.append(text);
    return *this;
  }
  [[nodiscard]] std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads them back. Past the end it yields zeros and `ok()` turns false for good, so that a parser
/// checks once per record.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  T Take() {
    static_assert(std::is_arithmetic_v<T>);
    T value{};
    if (bytes_.size() - at_ < sizeof(T)) {
      ok_ = false;
      return value;
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  /// Text up to a zero byte.
  std::string TakeText() {
    const size_t end = bytes_.find('\0', at_);
    if (end == std::string_view::npos) {
      ok_ = false;
      return {};
    }
    std::string text(bytes_.substr(at_, end - at_));
    at_ = end + 1;
    return text;
  }
  /// A number of records of at least `record_bytes` each; not ok when the rest cannot hold them.
  size_t TakeCount(size_t record_bytes) {
    const uint64_t count = Take<uint64_t>();
    if (count > (bytes_.size() - at_) / record_bytes) {
      ok_ = false;
      return 0;
    }
    return static_cast<size_t>(count);
  }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool AtEnd() const { return at_ == bytes_.size(); }
  [[nodiscard]] size_t Position() const { return at_; }

 private:
  std::string_view bytes_;
  size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace orbweave
